#include "restoration/mean_plane.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "restoration/triangle_slopes.h"

namespace reflines {
namespace {

double find_lift(const Vector2& slope) { return 1.0 / std::sqrt(1.0 + slope.squaredNorm()); }

// Returns (I + g g^T)^(1/2).
Eigen::Matrix2d find_stretch(const Vector2& slope) {
  return Eigen::Matrix2d::Identity() + slope * slope.transpose() / (1.0 + 1.0 / find_lift(slope));
}

Vector2 find_mean_slope(const HeightField& field) {
  return find_slopes(field.xy, field.F, field.z).transpose() * field.area / field.area.sum();
}

}  // namespace

MeanPlane::MeanPlane(const HeightField& field)
    : slope_(find_mean_slope(field)), stretch_(find_stretch(slope_)), lift_(find_lift(slope_)) {}

HeightField MeanPlane::project(HeightField field) const {
  field.xy *= stretch_;
  field.z = project_heights(field.z, field.xy);
  field.area /= lift_;
  return field;
}

// Uses that the slope is an eigenvector of the stretch, of the eigenvalue 1 / c: g.p = c g.(S p).
Vector MeanPlane::project_heights(const Vector& z, const PlanePositions& xy) const {
  return lift_ * (z - xy * (lift_ * slope_));
}

TangentMap MeanPlane::map_to_tangent(const Vector2& slope) const {
  const Vector2 in_view = slope_ + stretch_ * slope / lift_;
  return {find_stretch(in_view) * stretch_.inverse(), find_lift(in_view) / lift_};
}

TangentMap find_tangent_map(const Vector2& slope) { return {find_stretch(slope), find_lift(slope)}; }

Eigen::Matrix3d substitute(const Eigen::Matrix2d& A) {
  constexpr double kRoot = std::numbers::sqrt2;
  Eigen::Matrix3d result;
  for (int k = 0; k < 3; ++k) {
    const Vector3 unit = Vector3::Unit(k);
    Eigen::Matrix2d hessian;
    hessian << unit(0), unit(1) / kRoot, unit(1) / kRoot, unit(2);
    hessian = A.transpose() * hessian * A;
    result.row(k) << hessian(0, 0), kRoot * hessian(0, 1), hessian(1, 1);
  }
  return result;
}

}  // namespace reflines
