#include "optimization/active_bounds.h"

#include <algorithm>
#include <utility>

#include "optimization/bounded_quadratic.h"

namespace reflines {
namespace {

// The largest part of the projected gradient that a step with the kept factor may leave because the set of held
// unknowns has changed.
constexpr double kWorthwhile = 0.1;

}  // namespace

int ActiveBounds::count_beyond(const Vector& x) const {
  return static_cast<int>((bounds_.nearest(x).array() != x.array()).count());
}

void ActiveBounds::aim_at(const Vector& minimum) {
  work_.held = bounds_.touched_by(minimum);
  work_.many_contacts = false;
}

Vector ActiveBounds::go_towards(const Vector& minimum, const Vector& x) const {
  const Vector way = minimum - x;
  double step = 1.0;
  for (int k = 0; k < way.size(); ++k) {
    if (way(k) > 0) step = std::min(step, (bounds_.high(k) - x(k)) / way(k));
    if (way(k) < 0) step = std::min(step, (bounds_.low(k) - x(k)) / way(k));
  }
  return bounds_.nearest(x + step * way);
}

bool ActiveBounds::has_factor(HessianModel model) const {
  return work_.has_bounded_factor_of(model, bounds_.low.size());
}

std::optional<Vector> ActiveBounds::lead_on(double left, QuasiNewtonMemory* memory) {
  const QuadraticModel model{work_.matrix, work_.gradient};
  const Bounds room = bounds_.seen_from(work_.x);
  const Vector at_bounds = room.ends(work_.held);
  Vector d = at_bounds.isZero(0) ? Vector(-work_.gradient) : Vector(-model.gradient_at(at_bounds));
  if (memory != nullptr) memory->before_solve(d);
  counts_.solves += work_.held_factor.solve(d);
  if (memory != nullptr) memory->after_solve(d);
  d += at_bounds;
  if (measure_missed_gradient(model, room, work_.held, d) > kWorthwhile * left) return {};
  return bounds_.nearest(work_.x + d);
}

Vector ActiveBounds::solve_model(double wanted) {
  const QuadraticModel model{work_.matrix, work_.gradient};
  const Bounds room = bounds_.seen_from(work_.x);
  BoundedQuadratic::Minimum minimum = BoundedQuadratic(model, room, wanted, work_.held_factor, counts_, progress_)
                                          .minimize(std::move(work_.held), work_.many_contacts);
  work_.held = std::move(minimum.held);
  work_.many_contacts = minimum.many;
  Vector end = bounds_.nearest(work_.x + minimum.d);
  for (int k = 0; k < end.size(); ++k) {
    if (work_.held[k] != Side::kBetween) end(k) = bounds_.end(k, work_.held[k]);
  }
  return end;
}

bool ActiveBounds::prepare_pair(const Vector& step, Vector& change) const {
  for (int k = 0; k < step.size(); ++k) {
    if (work_.held[k] == Side::kBetween) continue;
    if (step(k) != 0.0) return false;
    change(k) = 0.0;
  }
  return true;
}

}  // namespace reflines
