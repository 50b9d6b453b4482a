// One run of a Minimizer within limits of linear functions: sequential quadratic programming on a kept factor.
#pragma once

#include <limits>
#include <optional>

#include "optimization/contact_quadratic.h"
#include "optimization/line_search.h"
#include "optimization/problem.h"
#include "optimization/refactor_policy.h"
#include "optimization/row_interior_point.h"
#include "optimization/row_limits.h"
#include "optimization/stopping_tests.h"
#include "optimization/workspace.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// One run of sequential quadratic programming. It starts with the unlimited minimum: where that lies within the limits
// it is the result, to the last bit. Otherwise a quadratic model with the limits (see ContactQuadratic) determines the
// contacts, and steps with its factor along them, accelerated like those of Descent, follow while these stay the same.
// Where there are too many contacts for that, every step is one of RowInteriorPoint with a new model. All points are
// within the limits. It ends where the gradient, of which the contacts' forces are taken off, has reached
// the tolerance relative to the gradient at the start: a Karush-Kuhn-Tucker point.
class ContactDescent {
 public:
  // Takes what a run needs; all outlive it, and `progress` may be null.
  ContactDescent(Problem& problem, const RowLimits& limits, const MinimizerOptions& options, Progress* progress,
                 Workspace& workspace);

  // Implements Minimizer::minimize; `seconds` is left to the caller. A start outside the limits is first moved into
  // them, straight towards their origin.
  Report run(Vector& x);

 private:
  bool start_near_free_minimum(const Vector& x);
  bool nothing_may_move(const Vector& start, int put_back);
  void start_on_the_way(const Vector& start, const Vector& minimum);
  void descend();
  void finish(Vector& x);

  // These are the steps of the loop. Those that return bool return false where the run is to stop or the step could not
  // be made.
  bool choose_destination();
  bool model_is_outdated() const;
  bool renew_model();
  bool kept_contacts_lead_on();
  bool solve_model();
  void solve_from_inside();
  bool find_step();
  void try_step(double step);
  void take_step();
  bool discard_model();
  void measure();

  bool gradient_is_small();  // a stopping test, see StoppingTests

  double evaluate(const Vector& x, Vector& gradient);
  Vector room(const Contacts& contacts) const;  // the way of their functions to the ends of their range, #contacts
  bool learns_from_steps() const { return options_.strategy == Strategy::kAdaptive; }
  bool model_is_fresh() const { return assembled_at_ == report_.iterations; }

  Problem& problem_;
  const RowLimits& limits_;
  const MinimizerOptions& options_;
  Progress* progress_;
  Workspace& work_;
  Report report_;
  RowLimits::Narrow narrow_;
  std::optional<ContactQuadratic> quadratic_;
  RefactorPolicy policy_;
  GradientNorm gradient_;  // of left_
  StoppingTests stopping_;

  LinePoint current_, trial_;
  Contacts contacts_;
  bool many_contacts_ = false;
  Vector forces_;               // of the contacts, where there are many
  Vector left_;                 // the gradient without the contacts' forces
  bool all_press_ = true;       // no force has the wrong sign
  bool contacts_keep_ = false;  // the present step moves no contact
  bool moved_ = false;
  bool digits_end_ = false;  // a new model of many contacts has not brought the gradient down
  double reached_norm_ = std::numeric_limits<double>::infinity();  // gradient_.now after the last step
  int assembled_at_ = -1;     // iteration at whose point the matrix was assembled; -1: before this run
  bool model_failed_ = true;  // no step with it lowers the energy, or its prediction was wrong
};

}  // namespace reflines
