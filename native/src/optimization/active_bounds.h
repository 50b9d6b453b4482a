// The active set of bounds: unknowns at an end of their range.
#pragma once

#include "optimization/active_set.h"
#include "optimization/bounds.h"
#include "optimization/workspace.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

// Steps end within the bounds to the last bit, and contacts at them. The set stays in the workspace for the next run.
class ActiveBounds : public ActiveSet {
 public:
  // Takes what outlives it; `counts` collects factorizations and solves, `progress` may be null.
  ActiveBounds(const Bounds& bounds, Workspace& workspace, Report& counts, Progress* progress)
      : bounds_(bounds), work_(workspace), counts_(counts), progress_(progress) {}

  int count_beyond(const Vector& x) const override;
  bool contain(const Vector& x) const override { return bounds_.nearest(x) == x; }
  bool may_move() const override { return (bounds_.low.array() != bounds_.high.array()).any(); }
  Vector move_inside(const Vector& x) const override { return bounds_.nearest(x); }
  Vector keep_inside(Vector x) const override { return bounds_.nearest(x); }
  void aim_at(const Vector& minimum) override;
  Vector go_towards(const Vector& minimum, const Vector& x) const override;
  bool has_factor(HessianModel model) const override;
  double measure_gradient() override { return bounds_.projected_norm(work_.x, work_.gradient); }
  std::optional<Vector> lead_on(double left, QuasiNewtonMemory* memory) override;
  Vector solve_model(double wanted) override;
  bool prepare_pair(const Vector& step, Vector& change) const override;

 private:
  const Bounds& bounds_;
  Workspace& work_;
  Report& counts_;
  Progress* progress_;
};

}  // namespace reflines
