#include "inspection/lines_across.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace reflines {
namespace {

constexpr double kEdgeOn = 0.2;  // cosine between view and normal
constexpr double kDegrees = 180 / std::numbers::pi;

Vector3 full_normal(const SheetPoint& point) {
  const Vector3 across = point.x.cross(point.y);
  return across - point.slope.x() * point.x - point.slope.y() * point.y;
}

}  // namespace

LinesAcross::LinesAcross(const Vector3& view_direction, const Vector3& line_direction, double spacing, double sparse)
    : frame_(view_direction, line_direction), spacing_(spacing), sparse_(sparse) {
  for (const Vector3& direction : {line_direction, Vector3(view_direction.cross(line_direction))})
    lights_.emplace_back(frame_, view_direction, direction);
}

// Returns the gradient of theta over the plane of the fit.
Vector2 LinesAcross::gradient(const ReflectionFunction& light, const SheetPoint& point) const {
  const Vector3 n = frame_.to_frame(full_normal(point));
  const Vector3 along_x = -frame_.to_frame(point.second(0) * point.x + point.second(1) * point.y);
  const Vector3 along_y = -frame_.to_frame(point.second(1) * point.x + point.second(2) * point.y);
  const ThetaDerivatives d = light.derivatives(-n.x() / n.z(), -n.y() / n.z(), 1);
  const auto change = [&](const Vector3& dn) {
    const double p = (n.x() * dn.z() - dn.x() * n.z()) / (n.z() * n.z());
    const double q = (n.y() * dn.z() - dn.y() * n.z()) / (n.z() * n.z());
    return d.p * p + d.q * q;
  };
  return {change(along_x), change(along_y)};
}

LineJump LinesAcross::compare(const SheetPoint& own, const SheetPoint& other) const {
  LineJump jump;
  const Vector3 n = frame_.to_frame(own.normal), m = frame_.to_frame(other.normal);
  if (std::min(n.z(), m.z()) < kEdgeOn) return jump;
  for (const ReflectionFunction& light : lights_) {
    const double apart = std::abs(wrap_angle(light.theta(m) - light.theta(n)));
    jump.offset = std::max(jump.offset, 100 * apart / spacing_);
    const Vector2 g = gradient(light, own), h = gradient(light, other);
    if (std::min(g.norm(), h.norm()) * sparse_ < spacing_) continue;
    const double angle = std::atan2(std::abs(g.x() * h.y() - g.y() * h.x()), std::abs(g.dot(h)));
    jump.angle = std::max(jump.angle, angle * kDegrees);
  }
  return jump;
}

}  // namespace reflines
