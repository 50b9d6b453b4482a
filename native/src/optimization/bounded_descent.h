// One run of a Minimizer within bounds: sequential quadratic programming on a kept factor.
#pragma once

#include "optimization/bounded_quadratic.h"
#include "optimization/bounds.h"
#include "optimization/line_search.h"
#include "optimization/problem.h"
#include "optimization/refactor_policy.h"
#include "optimization/stopping_tests.h"
#include "optimization/wording.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// One run of sequential quadratic programming. It starts with the unbounded minimum: where that lies within the bounds
// it is the result, to the last bit. Otherwise a quadratic model with exact bounds (see BoundedQuadratic) determines
// the held unknowns, and steps with its factor, accelerated like those of Descent, follow while these stay the same.
// All points are within the bounds, to the last bit. It ends where the projected gradient, see Bounds, has reached the
// tolerance: a Karush-Kuhn-Tucker point.
class BoundedDescent {
 public:
  // Takes what a run needs; all outlive it, and `progress` may be null.
  BoundedDescent(Problem& problem, const Bounds& bounds, const MinimizerOptions& options, Progress* progress,
                 Workspace& workspace);

  // Implements Minimizer::minimize; `seconds` is left to the caller. A start outside the bounds is first moved into
  // them.
  Report run(Vector& x);

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

  bool has_factor() const { return work_.has_bounded_factor_of(choose_model(options_.strategy), work_.x.size()); }
  bool learns_from_steps() const { return options_.strategy == Strategy::kAdaptive; }
  bool model_is_fresh() const { return assembled_at_ == report_.iterations; }
  QuadraticModel model() const { return {work_.matrix, work_.gradient}; }

  Problem& problem_;
  const Bounds& bounds_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Workspace& work_;
  Report report_;
  BoundedQuadratic quadratic_;
  RefactorPolicy policy_;
  GradientNorm gradient_;  // projected, see Bounds
  StoppingTests stopping_;

  LinePoint current_, trial_;
  Vector destination_;  // end of a full step
  bool moved_ = false;
  int assembled_at_ = -1;      // iteration at whose point the matrix was assembled; -1: before this run
  bool renewed_ = false;       // that matrix replaces one whose steps have cost as much
  bool model_failed_ = false;  // no step with it lowers the energy, or its prediction was wrong
};

}  // namespace reflines
