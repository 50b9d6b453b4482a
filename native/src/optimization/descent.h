// One run of a Minimizer: the loop, its steps, its stopping tests.
#pragma once

#include "optimization/line_search.h"
#include "optimization/problem.h"
#include "optimization/refactor_policy.h"
#include "optimization/stopping_tests.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

class Descent {
 public:
  // Takes what a run needs; all outlive it, and `progress` may be null.
  Descent(Problem& problem, const MinimizerOptions& options, Progress* progress, Workspace& workspace);

  // Implements Minimizer::minimize; `seconds` is left to the caller.
  Report run(Vector& x);

 private:
  void evaluate_start(const Vector& x);
  void approach();
  int move_along_coarse();
  void analyze(const SparseMatrix& matrix);
  void measure_rounding(const Vector& weight);
  void descend();
  void finish(Vector& x);

  // These are the steps of the loop. Those that return bool return false where the run is to stop or the step could not
  // be made.
  bool factor_is_kept() const;
  bool factor_is_outdated() const;
  bool renew_factor();
  void choose_direction();
  bool find_step();
  void try_step(double step);
  void take_step();
  void accept_trial();
  bool discard_factor();

  // These are stopping tests, as those of StoppingTests.
  bool gradient_is_small();
  bool gradient_is_rounding();
  bool step_is_rounding();

  bool learns_from_steps() const { return options_.strategy == Strategy::kAdaptive; }
  bool has_moved() const { return report_.iterations + report_.coarse_iterations > 0; }
  bool factor_is_fresh() const { return factored_at_ == report_.iterations; }

  Problem& problem_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Workspace& work_;
  Report report_;
  RefactorPolicy policy_;
  GradientNorm gradient_;
  StoppingTests stopping_;

  LinePoint current_, trial_;
  int factored_at_ = -1;        // iteration at whose point the factor was made; -1: before this run
  bool factor_failed_ = false;  // a full step with it was refused
};

}  // namespace reflines
