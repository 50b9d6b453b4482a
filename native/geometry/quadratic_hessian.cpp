// Second derivatives of the quadratic through the six points of a triangle and its three neighbours, in closed form:
// the basis quadratic of point j is the conic through the other five, by Braikenridge-Maclaurin (paper, appendix).
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>

#include "native/geometry/stencil.h"

namespace reflines {
namespace {

using Matrix3 = Eigen::Matrix3d;

// Below this the five-point conic almost passes through the sixth point. Points are scaled to the size of the stencil,
// the conic to unit norm; measured: sane irregular stencils have 1e-3 and more, exact conics 1e-16.
constexpr double kOnConic = 1e-10;

Matrix3 cross_matrix(const Vector3& a) {
  Matrix3 R;
  R << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return R;
}

// [a]x [b]x
Matrix3 cross_product(const Vector3& a, const Vector3& b) {
  Matrix3 R = b * a.transpose();
  R.diagonal().array() -= a.dot(b);
  return R;
}

// The conic through five points in homogeneous coordinates as a symmetric matrix of unit norm, or zero where it is not
// unique.
Matrix3 conic_through(const std::array<Vector3, 5>& w) {
  const Vector3 l12 = w[0].cross(w[1]), l23 = w[1].cross(w[2]), l34 = w[2].cross(w[3]), l45 = w[3].cross(w[4]);
  const Vector3 r = l12.cross(l45);
  const Matrix3 M = cross_product(w[0], l34) * cross_matrix(r) * cross_product(l23, w[4]);
  const Matrix3 symmetric = M + M.transpose();
  const double norm = symmetric.norm();
  return norm > 0 ? Matrix3(symmetric / norm) : Matrix3::Zero();
}

// The six points, three corners first, moved and scaled to unit size; the scale is returned in `size`.
std::array<Vector3, 6> normalized_points(const HeightField& field, const std::vector<int>& vertex, double& size) {
  Vector2 centre = Vector2::Zero();
  for (int v : vertex) centre += field.xy.row(v).transpose() / 6.0;
  size = 0;
  for (int v : vertex) size = std::max(size, (field.xy.row(v).transpose() - centre).norm());
  std::array<Vector3, 6> points;
  for (int j = 0; j < 6; ++j) points[j] << (field.xy.row(vertex[j]).transpose() - centre) / size, 1.0;
  return points;
}

int opposite_vertex(const HeightField& field, int t, int other) {
  for (int j = 0; j < 3; ++j) {
    const int v = field.F(other, j);
    if (v != field.F(t, 0) && v != field.F(t, 1) && v != field.F(t, 2)) return v;
  }
  return -1;
}

std::vector<int> six_points(const HeightField& field, int t) {
  std::vector<int> vertex = {field.F(t, 0), field.F(t, 1), field.F(t, 2)};
  for (int i = 0; i < 3; ++i) {
    const int other = field.neighbors(t, i);
    const int v = other < 0 ? -1 : opposite_vertex(field, t, other);
    if (v < 0 || std::find(vertex.begin(), vertex.end(), v) != vertex.end()) return {};  // a border, or valence three
    vertex.push_back(v);
  }
  return vertex;
}

}  // namespace

HessianStencil quadratic_hessian(const HeightField& field, int t) {
  HessianStencil stencil;
  const std::vector<int> vertex = six_points(field, t);
  if (vertex.empty()) return stencil;
  double size = 0;
  const std::array<Vector3, 6> w = normalized_points(field, vertex, size);
  stencil.weight.resize(3, 6);
  for (int j = 0; j < 6; ++j) {
    const Matrix3 conic =
        conic_through({w[(j + 1) % 6], w[(j + 2) % 6], w[(j + 3) % 6], w[(j + 4) % 6], w[(j + 5) % 6]});
    const double value = w[j].dot(conic * w[j]);
    if (std::abs(value) < kOnConic) return stencil;
    stencil.weight.col(j) = Vector3(conic(0, 0), conic(0, 1), conic(1, 1)) * (2.0 / (value * size * size));
  }
  stencil.vertex = vertex;
  return stencil;
}

}  // namespace reflines
