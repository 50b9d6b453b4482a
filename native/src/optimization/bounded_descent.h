// One run of a Minimizer within bounds: sequential quadratic programming on a kept factor.
#pragma once

#include <string>

#include "optimization/bounded_quadratic.h"
#include "optimization/bounds.h"
#include "optimization/line_search.h"
#include "optimization/problem.h"
#include "optimization/refactor_policy.h"
#include "optimization/wording.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// Starts with the free minimum: where that lies within the bounds it is the result, to the bit. Else a quadratic model
// with exact bounds (see BoundedQuadratic) says which unknowns are held, and steps with its factor, accelerated like
// those of Descent, follow, as long as they hold the same ones. All points are within the bounds, to the bit. Ends
// where the projected gradient, see Bounds, is down by the tolerance: a Karush-Kuhn-Tucker point.
class BoundedDescent {
 public:
  // `progress` may be null; all five outlive the run.
  BoundedDescent(Problem& problem, const Bounds& bounds, const MinimizerOptions& options, Progress* progress,
                 Workspace& workspace);

  // As Minimizer::minimize; `seconds` is left to the caller. A start outside the bounds is first moved into them.
  Report run(Vector& x);

 private:
  void evaluate_start(const Vector& x);
  bool may_move();
  bool start_near_free_minimum();
  void start_on_the_way_to(const Vector& minimum);
  void descend();
  void finish(Vector& x);

  // Steps of the loop. The boolean ones return false where the run is to stop or the step could not be made.
  bool model_is_outdated() const;
  bool renew_model();
  void measure_rounding();
  bool choose_destination();
  bool kept_factor_leads_on();
  bool solve_model();
  bool find_step();
  void try_step(double step);
  void take_step();
  bool blame_model();

  // Stopping tests. Each that holds writes Report::termination and its sentence.
  bool is_cancelled();
  bool gradient_is_small();
  bool iterations_are_used_up();
  bool stop(Termination termination, const std::string& message);

  bool has_factor() const { return work_.has_bounded_factor_of(model_of(options_.strategy), work_.x.size()); }
  bool learns_from_steps() const { return options_.strategy == Strategy::kAdaptive; }
  bool model_is_fresh() const { return assembled_at_ == report_.iterations; }
  QuadraticModel model() const { return {work_.matrix, work_.gradient}; }
  void tell(const char* stage);

  Problem& problem_;
  const Bounds& bounds_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Workspace& work_;
  Report report_;
  HeldFactor factor_;
  RefactorPolicy policy_;

  LinePoint current_, trial_;
  Vector destination_;  // of a whole step
  bool moved_ = false;
  double norm_ = 0.0;  // of the projected gradient
  double wanted_norm_ = 0.0;
  double rounding_ = 0.0;      // the change of the gradient that rounding x alone makes
  int assembled_at_ = -1;      // the iteration whose point the matrix belongs to; -1: made before this run
  bool model_failed_ = false;  // no step with it lowers the energy, or it foretold too little
};

}  // namespace reflines
