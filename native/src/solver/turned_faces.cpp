#include "solver/turned_faces.h"

#include <cmath>
#include <numbers>

#include "geometry/crease.h"

namespace reflines {
namespace {

constexpr double kTurned = std::numbers::pi / 4;

}  // namespace

Mask find_turned(const Vector3& axis, const Positions& V, const Triangles& F, const Vector& move) {
  const Positions before = triangle_normals(V, F), after = triangle_normals(V + move * axis.transpose(), F);
  Mask result(F.rows());
  for (Eigen::Index t = 0; t < F.rows(); ++t)
    result(t) = before.row(t).dot(after.row(t)) < std::cos(kTurned) * before.row(t).norm();
  return result;
}

Mask find_corners(const Triangles& F, const Mask& triangles, Eigen::Index vertex_count) {
  Mask result = Mask::Constant(vertex_count, false);
  for (Eigen::Index t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3 && triangles(t); ++i) result(F(t, i)) = true;
  }
  return result;
}

}  // namespace reflines
