#include "targets/handle_conflicts.h"

#include <cmath>

#include "reflection/reflection_function.h"

namespace reflines {
namespace {

// The fraction of the way between two places that must lead across the lines: of places along one line the order
// changes as soon as the line tilts.
constexpr double kAcross = 0.5;
constexpr double kSteepest = 20.0;  // how many times denser than now lines can be
constexpr double kRounding = 1e-9;  // radians

}  // namespace

bool force_crossing(const RegionField& field, const HandlePlace& one, const HandlePlace& other) {
  const Vector2 way = other.point - one.point;
  const Vector2 gradient = 0.5 * (field.gradient.row(one.at.triangle) + field.gradient.row(other.at.triangle));
  const double now = wrap_angle(other.theta - one.theta);
  const double wanted = now + other.change - one.change;
  if (std::abs(wanted) > kSteepest * gradient.norm() * way.norm() + kRounding) return true;
  return std::abs(gradient.dot(way)) > kAcross * gradient.norm() * way.norm() && now * wanted < 0;
}

}  // namespace reflines
