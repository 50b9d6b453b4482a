#include "restoration/triangle_slopes.h"

#include <cmath>

#include "reflection/scalar_gradient.h"

namespace reflines {

PlaneVectors find_slopes(const PlanePositions& xy, const Triangles& F, const Vector& z) {
  PlaneVectors result(F.rows(), 2);
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const double a = z(F(t, 0));
    result.row(t) = linear_gradient(xy, F.row(t), z(F(t, 1)) - a, z(F(t, 2)) - a);
  }
  return result;
}

PlanePositions find_vertex_gradients(const PlanePositions& xy, const Triangles& F, const Vector& z) {
  PlanePositions result = PlanePositions::Zero(xy.rows(), 2);
  Vector area = Vector::Zero(xy.rows());
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Vector2 b = xy.row(F(t, 1)) - xy.row(F(t, 0)), c = xy.row(F(t, 2)) - xy.row(F(t, 0));
    const double doubled = b.x() * c.y() - b.y() * c.x();
    const double up = z(F(t, 1)) - z(F(t, 0)), on = z(F(t, 2)) - z(F(t, 0));
    const Vector2 gradient = Vector2(up * c.y() - on * b.y(), on * b.x() - up * c.x()) * (doubled < 0 ? -1.0 : 1.0);
    for (int i = 0; i < 3; ++i) {
      result.row(F(t, i)) += gradient;
      area(F(t, i)) += std::abs(doubled);
    }
  }
  for (Eigen::Index v = 0; v < area.size(); ++v) {
    if (area(v) > 0) result.row(v) /= area(v);
  }
  return result;
}

}  // namespace reflines
