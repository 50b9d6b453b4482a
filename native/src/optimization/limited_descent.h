// One run of a Minimizer within limits: sequential quadratic programming on a kept factor.
#pragma once

#include <limits>

#include "optimization/active_set.h"
#include "optimization/line_search.h"
#include "optimization/problem.h"
#include "optimization/refactor_policy.h"
#include "optimization/stopping_tests.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// One run of sequential quadratic programming. It starts with the free minimum: where that lies within the limits it is
// the result, to the last bit. Otherwise a quadratic model with the limits determines the contacts, and steps with its
// factor, accelerated like those of Descent, follow while these stay the same. All points are within the limits. It
// ends where the gradient without the contacts' forces has reached the tolerance: a Karush-Kuhn-Tucker point.
class LimitedDescent {
 public:
  // Takes what a run needs; all outlive it, and `progress` may be null.
  LimitedDescent(Problem& problem, ActiveSet& active, const MinimizerOptions& options, Progress* progress,
                 Workspace& workspace, Report& report);

  // Implements Minimizer::minimize; `seconds` is left to the caller.
  void run(Vector& x);

 private:
  void evaluate_start(const Vector& x);
  bool may_move();
  bool start_near_free_minimum();
  void start_on_the_way_to(const Vector& minimum);
  void descend();
  void finish(Vector& x);
  void count_steps();

  // These are the steps of the loop. Those that return bool return false where the run is to stop or the step could not
  // be made.
  bool model_is_outdated() const;
  bool new_model_pays() const;
  bool renew_model();
  void measure_rounding(const Vector& weight);
  bool choose_destination();
  bool kept_factor_leads_on();
  bool solve_model();
  bool find_step();
  void try_step(double step);
  void take_step();
  bool discard_model();

  bool gradient_is_small();  // a stopping test, see StoppingTests

  double evaluate(const Vector& x, Vector& gradient);
  bool learns_from_steps() const { return options_.strategy == Strategy::kAdaptive; }
  bool model_is_fresh() const { return assembled_at_ == report_.iterations; }

  Problem& problem_;
  ActiveSet& active_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Workspace& work_;
  Report& report_;
  RefactorPolicy policy_;
  GradientNorm gradient_;  // without the contacts' forces
  StoppingTests stopping_;

  LinePoint current_, trial_;
  Vector destination_;  // end of a full step
  bool moved_ = false;
  int assembled_at_ = -1;      // iteration at whose point the matrix was assembled; -1: before this run
  bool renewed_ = false;       // that matrix replaces one whose steps have cost as much
  bool model_failed_ = false;  // no step with it lowers the energy, or its prediction was wrong
  bool digits_end_ = false;    // a new matrix for each step has not brought the gradient down
  double reached_norm_ = std::numeric_limits<double>::infinity();  // gradient_.now after the last such step
};

}  // namespace reflines
