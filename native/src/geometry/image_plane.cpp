#include "reflines/image_plane.h"

#include <Eigen/Geometry>
#include <string>

#include "reflines/errors.h"

namespace reflines {
namespace {

// The sine of the smallest angle between view and lines: below it theta turns by 2 pi within a pixel.
constexpr double kParallel = 1e-3;

Vector3 normalize(const Vector3& direction, const std::string& name) {
  if (!direction.allFinite() || direction.norm() == 0.0) {
    throw InvalidInput("The " + name + " has no direction (zero length or not a number); give three finite numbers.");
  }
  return direction.stableNormalized();
}

}  // namespace

ImagePlane::ImagePlane(const Vector3& view_direction, const Vector3& line_direction) {
  z_ = normalize(view_direction, "view direction");
  const Vector3 a = normalize(line_direction, "line direction");
  const Vector3 projected = a - a.dot(z_) * z_;
  if (projected.norm() < kParallel) {
    throw InvalidInput(
        "The light direction is parallel to the view, so no reflection lines can be seen; turn the light empty (its "
        "local Z) "
        "away from the view.");
  }
  y_ = projected.normalized();
  x_ = y_.cross(z_);
}

PlanePositions ImagePlane::project(const Positions& V) const {
  PlanePositions xy(V.rows(), 2);
  xy.col(0) = V * x_;
  xy.col(1) = V * y_;
  return xy;
}

Vector ImagePlane::heights(const Positions& V) const { return V * z_; }

}  // namespace reflines
