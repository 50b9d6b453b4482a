#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reflines/image_plane.h"
#include "reflines/inspect_panel.h"

namespace reflines {
namespace {

constexpr double kTurn = 25.0 * std::numbers::pi / 180.0;
constexpr int kLights = 8;

// Returns the direction, across the view, that is up in the picture.
Vector3 find_up(const ImagePlane& plane, const Vector3& up) {
  const Vector3 across = up - up.dot(plane.z()) * plane.z();
  return across.allFinite() && across.norm() > 1e-3 * up.norm() ? across.normalized() : plane.y();
}

}  // namespace

WalkAround walk_around(const Vector3& view_direction, const Vector3& line_direction, const Vector3& up) {
  const ImagePlane plane(view_direction, line_direction);
  const Vector3 z = plane.z(), y = find_up(plane, up), x = y.cross(z), line = line_direction.stableNormalized();
  const double turn = std::min(kTurn, 0.5 * std::acos(std::min(std::abs(line.dot(z)), 1.0)));
  WalkAround result{Positions(5, 3), Positions(kLights, 3)};
  result.views.row(0) = z;
  const Vector3 aside[] = {-x, x, y, -y};
  for (int k = 0; k < 4; ++k) result.views.row(k + 1) = std::cos(turn) * z + std::sin(turn) * aside[k];
  for (int k = 0; k < kLights; ++k) result.lines.row(k) = Eigen::AngleAxisd(k * std::numbers::pi / kLights, z) * line;
  return result;
}

}  // namespace reflines
