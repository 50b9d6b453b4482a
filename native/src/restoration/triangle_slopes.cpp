#include "restoration/triangle_slopes.h"

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

}  // namespace reflines
