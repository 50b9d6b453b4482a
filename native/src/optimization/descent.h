// One run of a Minimizer: the loop, its steps, its stopping tests.
#pragma once

#include <string>

#include "optimization/line_search.h"
#include "optimization/problem.h"
#include "optimization/refactor_policy.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

class Descent {
 public:
  // `progress` may be null; all four outlive the run.
  Descent(Problem& problem, const MinimizerOptions& options, Progress* progress, Workspace& workspace);

  // As Minimizer::minimize; `seconds` is left to the caller.
  Report run(Vector& x);

 private:
  void evaluate_start(const Vector& x);
  void approach();
  int move_along_coarse();
  void analyze(const SparseMatrix& matrix);
  void measure_rounding(const Vector& weight);
  void descend();
  void finish(Vector& x);

  // Steps of the loop. The boolean ones return false where the run is to stop or the step could not be made.
  bool factor_is_kept() const;
  bool factor_is_outdated() const;
  bool renew_factor();
  void choose_direction();
  bool find_step();
  bool backtrack();
  void try_step(double step);
  void take_step();
  void accept_trial();
  bool blame_factor();

  // Stopping tests. Each that holds writes Report::termination and its sentence.
  bool is_cancelled();
  bool gradient_is_small();
  bool gradient_is_rounding();
  bool step_is_rounding();
  bool iterations_are_used_up();
  bool stop(Termination termination, const std::string& message);

  bool learns_from_steps() const { return options_.strategy == Strategy::kAdaptive; }
  bool has_moved() const { return report_.iterations + report_.coarse_iterations > 0; }
  bool factor_is_fresh() const { return factored_at_ == report_.iterations; }
  void tell(const char* stage);

  Problem& problem_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Workspace& work_;
  Report report_;
  RefactorPolicy policy_;

  LinePoint current_, trial_;
  double gradient_norm_ = 0.0;
  double wanted_gradient_norm_ = 0.0;
  double gradient_rounding_ = 0.0;  // the change of the gradient that rounding x alone makes
  int factored_at_ = -1;            // the iteration whose point the factor belongs to; -1: made before this run
  bool factor_failed_ = false;      // a full step with it was refused
};

}  // namespace reflines
