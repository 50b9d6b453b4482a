// The active set of limits of linear functions: the contacts, functions at an end of their range.
#pragma once

#include <optional>

#include "optimization/active_set.h"
#include "optimization/contact_quadratic.h"
#include "optimization/row_limits.h"
#include "optimization/workspace.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// Contacts and steps are those of ContactQuadratic; where there are too many contacts for that, every step is one of
// InteriorPoint with a new matrix.
class ActiveRows : public ActiveSet {
 public:
  // Takes what outlives it; `counts` collects factorizations and solves, `progress` may be null.
  ActiveRows(const RowLimits& limits, Workspace& workspace, Report& counts, Progress* progress)
      : limits_(limits), work_(workspace), counts_(counts), progress_(progress) {}

  int count_beyond(const Vector& x) const override { return limits_.count_beyond(x); }
  bool contain(const Vector& x) const override { return limits_.contain(x); }
  bool may_move() const override { return narrow_ ? narrow_->may_move() : !limits_.are_zero(); }
  Vector move_inside(const Vector& x) const override;
  void aim_at(const Vector& minimum) override;
  Vector go_towards(const Vector& minimum, const Vector& x) const override { return narrow_->pull_inside(x, minimum); }
  bool has_factor(HessianModel) const override { return false; }
  void forget_factor() override { quadratic_->forget(); }
  bool renews_each_step() const override { return many_; }
  double measure_gradient() override;
  std::optional<Vector> lead_on(double left, QuasiNewtonMemory* memory) override;
  Vector solve_model(double wanted) override;
  bool prepare_pair(const Vector&, Vector&) const override { return contacts_keep_; }

 private:
  Vector solve_from_inside(const Vector& low, const Vector& high, double wanted);
  Vector room() const;  // the way of the contacts' functions to the ends of their range, #contacts

  const RowLimits& limits_;
  Workspace& work_;
  Report& counts_;
  Progress* progress_;
  std::optional<RowLimits::Narrow> narrow_;  // where the free minimum is beyond the limits
  std::optional<ContactQuadratic> quadratic_;
  Contacts contacts_;
  bool many_ = false;
  Vector forces_;               // of the contacts, where there are many
  Vector left_;                 // the gradient without the contacts' forces
  bool all_press_ = true;       // no force has the wrong sign
  bool contacts_keep_ = false;  // the present step moves no contact
};

}  // namespace reflines
