// Second derivatives of the quadratic through the six points of a triangle and its three neighbours, in closed form:
// the basis quadratic of a point is the conic through the other five (paper, appendix).
//
// In the triangle's barycentric coordinates l the conics through its corners are k . m with m = (l1 l2, l2 l0, l0 l1),
// and the one through two further points p, q has k = m(p) x m(q): the appendix's construction with the corners as the
// base points. Its value at the last point is the triple product of the three m, zero where all six lie on one conic.
// The basis quadratics of the corners follow from those, since linear functions are interpolated too: l_i minus what
// the opposite points have of it.
#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "geometry/bend_contrast.h"
#include "geometry/stencil.h"

namespace reflines {
namespace {

// The triple product of the three m over their lengths below which the six points count as lying on one conic;
// invariant under affine maps. Measured: sane irregular stencils have 1e-3 and more, exact conics 1e-16.
constexpr double kOnConic = 1e-10;

// Finds the three opposite vertices; returns false on a border and at valence three, where points coincide.
bool find_opposite(const HeightField& field, int t, int (&opposite)[3]) {
  for (int i = 0; i < 3; ++i) {
    if (field.neighbors(t, i) < 0) return false;
    opposite[i] = field.F(field.neighbors(t, i), find_facing_corner(field.F, field.neighbors, t, i));
    if (opposite[i] == field.F(t, i)) return false;
  }
  return opposite[0] != opposite[1] && opposite[1] != opposite[2] && opposite[2] != opposite[0];
}

// Returns the gradients of the barycentric coordinates, one a column.
Eigen::Matrix<double, 2, 3> barycentric_gradients(const HeightField& field, int t) {
  Eigen::Matrix<double, 2, 3> gradient;
  for (int i = 0; i < 3; ++i) {
    const Vector2 edge = field.xy.row(field.F(t, (i + 2) % 3)) - field.xy.row(field.F(t, (i + 1) % 3));
    gradient.col(i) = Vector2(-edge.y(), edge.x()) * (0.5 / field.area(t));
  }
  return gradient;
}

// Returns (f_xx, f_xy, f_yy) of l1 l2, l2 l0 and l0 l1, one a column.
Eigen::Matrix3d bubble_hessians(const Eigen::Matrix<double, 2, 3>& gradient) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i) {
    const Vector2 a = gradient.col((i + 1) % 3), b = gradient.col((i + 2) % 3);
    result.col(i) << 2 * a.x() * b.x(), a.x() * b.y() + a.y() * b.x(), 2 * a.y() * b.y();
  }
  return result;
}

}  // namespace

HessianStencil quadratic_hessian(const HeightField& field, int t) {
  HessianStencil stencil;
  int opposite[3];
  if (!find_opposite(field, t, opposite)) return stencil;
  const Eigen::Matrix<double, 2, 3> gradient = barycentric_gradients(field, t);
  const Vector2 origin = field.xy.row(field.F(t, 0));
  Eigen::Matrix3d l, m;  // a column for each opposite point
  for (int j = 0; j < 3; ++j) {
    l.col(j) = gradient.transpose() * (field.xy.row(opposite[j]).transpose() - origin);
    l(0, j) += 1.0;
    m.col(j) << l(1, j) * l(2, j), l(2, j) * l(0, j), l(0, j) * l(1, j);
  }
  const double triple = m.col(0).dot(m.col(1).cross(m.col(2)));
  if (!(std::abs(triple) > kOnConic * m.col(0).norm() * m.col(1).norm() * m.col(2).norm())) return stencil;
  Eigen::Matrix3d conics;
  conics << m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)), m.col(0).cross(m.col(1));
  stencil.weight.resize(3, 6);
  stencil.weight.rightCols<3>() = bubble_hessians(gradient) * conics / triple;
  stencil.weight.leftCols<3>() = -stencil.weight.rightCols<3>() * l.transpose();
  stencil.vertex = {field.F(t, 0), field.F(t, 1), field.F(t, 2), opposite[0], opposite[1], opposite[2]};
  return stencil;
}

}  // namespace reflines
