// The active set of a descent within limits: the contacts, functions at an end of their range, and steps along these.
#pragma once

#include <optional>

#include "optimization/bounds.h"
#include "optimization/contact_quadratic.h"
#include "optimization/quasi_newton.h"
#include "optimization/row_limits.h"
#include "optimization/workspace.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// The limits of one run at the point and with the matrix of its Workspace, where the set of bounds stays for the next
// run. ContactQuadratic finds few contacts. Many are eliminated where they are single unknowns (minimize_bounded); else
// every step is one of minimize_from_inside with a new matrix. Steps end within bounds to the last bit, and contacts at
// them.
class ActiveSet {
 public:
  // Takes what outlives it; `progress` may be null.
  ActiveSet(const RowLimits& limits, Workspace& workspace, Progress* progress);

  int count_beyond(const Vector& x) const { return limits_.count_beyond(x); }
  bool contain(const Vector& x) const { return limits_.contain(x); }
  bool may_move() const { return narrow_ ? narrow_->may_move() : !limits_.are_zero(); }  // false where all are held
  Vector move_inside(const Vector& x) const;  // a point within the limits; x where it is one
  Vector keep_inside(const Vector& x) const { return narrow_->clip(x); }  // of a point between two within the limits

  // Prepares for the way to a free minimum beyond the limits, and returns the farthest point on the way from x.
  void aim_at(const Vector& minimum);
  Vector go_towards(const Vector& minimum, const Vector& x) const { return narrow_->pull_inside(x, minimum); }

  // Returns whether the workspace has a matrix and a factor of an earlier run.
  bool has_factor(HessianModel model) const;
  // Returns whether each step takes a new matrix.
  bool renews_each_step() const { return work_.many_contacts && !limits_.are_bounds(); }

  // Returns the norm of the gradient without the forces of the contacts: 0 at a minimum.
  double measure_gradient();

  // Returns the end of a step with the present factor and set, or nothing where others are needed; `left` is the
  // gradient measured last. `memory` may be null. Throws Cancelled, as `solve_model`.
  std::optional<Vector> lead_on(double left, QuasiNewtonMemory* memory);

  // Determines the set anew, and returns the end of the step to the model's minimum: down to `wanted`, where only a
  // number of solves leads there.
  Vector solve_model(double wanted);

  // Returns whether the present step moves no contact, so that the quasi-Newton memory may learn from it.
  bool keeps_contacts() const { return contacts_keep_; }

 private:
  ContactQuadratic contact_quadratic() { return {*narrow_, work_.held_factor.border(), progress_}; }
  Bounds room() const;  // the ranges of the functions' changes
  Vector find_ways(const Bounds& room);
  void take_off_forces();
  Vector search_contacts(const Bounds& room, double wanted);
  Vector eliminate_contacts(const Bounds& room, double wanted, bool anew, const Vector& d);
  Vector solve_from_inside(const Bounds& room, double wanted);

  const RowLimits& limits_;
  Workspace& work_;
  Progress* progress_;
  std::optional<RowLimits::Narrow> narrow_;  // of bounds, and of others where the free minimum is beyond the limits
  Contacts contacts_;
  Vector forces_;               // of the contacts that minimize_from_inside found
  Vector left_;                 // the gradient without the contacts' forces
  bool all_press_ = true;       // no force has the wrong sign
  bool contacts_keep_ = false;  // the present step moves no contact
};

}  // namespace reflines
