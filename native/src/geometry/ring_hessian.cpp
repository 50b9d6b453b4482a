// Second derivatives from the vertices of the triangles that touch T, by least squares. They exist wherever the ring
// does not lie on a conic: on borders, at valence three, on unstable six-point stencils.
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/sort_unique.h"
#include "geometry/local_monomials.h"
#include "geometry/stencil.h"
#include "geometry/stencil_quality.h"

namespace reflines {
namespace {

// The ratio of the smallest to the largest pivot of the moment matrix below which the ring is (nearly) on a conic. The
// matrix holds squares, so this is a ratio of 1e-5 between the points' own singular values.
constexpr double kOnConic = 1e-10;

// The cubic_error above which a cubic is fitted instead of a quadratic: what rings of compact triangles have at most.
// Round poles, with as much, cubics would double or triple the noise.
constexpr double kMostRingError = 0.4;

// The penalty on third derivatives, relative to one point of the fit at distance 1.
constexpr double kCubicPenalty = 1e-5;

// The largest number of vertices read around one corner, spread evenly: all of them up to valence 17. A pole with n
// spokes would otherwise put n weights on each of its n triangles and n^4 into their Hessian (n = 1024: 100 s instead
// of 0.5).
constexpr size_t kMostAround = 16;

int corner_of(const HeightField& field, int t, int v) { return field.F(t, 0) == v ? 0 : field.F(t, 1) == v ? 1 : 2; }

int find_corner_beyond(const HeightField& field, int now, int before) {
  for (int j = 0; j < 3; ++j) {
    if (field.neighbors(now, j) == before) return field.F(now, j);
  }
  return -1;
}

// Returns the vertices on the way around corner `v` from t, over edges that are no border and no crease: first starting
// with the edge after v, then with the one before it where that leads to others.
std::vector<int> collect_fan(const HeightField& field, int t, int v) {
  std::vector<int> vertices;
  for (int side = 1; side <= 2; ++side) {
    int before = t;
    int now = field.neighbors(t, (corner_of(field, t, v) + side) % 3);
    while (now >= 0 && now != t) {
      vertices.push_back(find_corner_beyond(field, now, before));
      const int i = corner_of(field, now, v);
      const int one = field.neighbors(now, (i + 1) % 3), other = field.neighbors(now, (i + 2) % 3);
      const int next = one == before ? other : one;
      before = now;
      now = next;
    }
    if (now == t) break;
  }
  return vertices;
}

void append_spread(const std::vector<int>& fan, std::vector<int>& vertices) {
  const size_t count = std::min(fan.size(), kMostAround);
  for (size_t k = 0; k < count; ++k) vertices.push_back(fan[(2 * k + 1) * fan.size() / (2 * count)]);
}

std::vector<int> ring(const HeightField& field, int t) {
  std::vector<int> around;
  for (int i = 0; i < 3; ++i) append_spread(collect_fan(field, t, field.F(t, i)), around);
  sort_unique(around);
  std::vector<int> vertex = {field.F(t, 0), field.F(t, 1), field.F(t, 2)};
  for (int v : around) {
    if (std::find(vertex.begin(), vertex.begin() + 3, v) == vertex.begin() + 3) vertex.push_back(v);
  }
  return vertex;
}

// Computes the second derivatives of the quadratic fitted by least squares: of the weights that are exact on quadratics
// those of smallest norm. Returns false where the points (nearly) lie on a conic.
bool fit_quadratic(const LocalMonomials& points, Eigen::Matrix3Xd& weight) {
  const auto P = points.value.topRows<6>();
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> moments(P * P.transpose());
  const auto pivots = moments.vectorD();
  if (pivots.minCoeff() < kOnConic * pivots.maxCoeff()) return false;
  Eigen::Matrix<double, 6, 3> wanted = Eigen::Matrix<double, 6, 3>::Zero();
  wanted.bottomRows<3>().setIdentity();
  weight = (P.transpose() * moments.solve(wanted)).transpose() / (points.size * points.size);
  return true;
}

// Computes the second derivatives of the cubic fitted by least squares with a penalty on its third derivatives: of the
// weights that are exact on quadratics nearly those of smallest error on cubics. The normal equations would lose twice
// the digits.
void fit_cubic(const LocalMonomials& points, Eigen::Matrix3Xd& weight) {
  const Eigen::Index n = points.value.cols();
  Eigen::Matrix<double, Eigen::Dynamic, 10> fit = Eigen::Matrix<double, Eigen::Dynamic, 10>::Zero(n + 4, 10);
  fit.topRows(n) = points.value.transpose();
  fit.bottomRightCorner<4, 4>().diagonal().setConstant(std::sqrt(kCubicPenalty));
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(fit);
  Eigen::Matrix<double, 10, 3> wanted = Eigen::Matrix<double, 10, 3>::Zero();
  wanted.middleRows<3>(3).setIdentity();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n + 4, 3);
  result.topRows<10>() = qr.matrixQR().topRows<10>().triangularView<Eigen::Upper>().transpose().solve(wanted);
  result.applyOnTheLeft(qr.householderQ());
  weight = result.topRows(n).transpose() / (points.size * points.size);
}

}  // namespace

HessianStencil ring_hessian(const HeightField& field, int t) {
  HessianStencil stencil;
  stencil.vertex = ring(field, t);
  if (stencil.vertex.size() < 6) return {};
  const LocalMonomials points = local_monomials(field, t, stencil.vertex);
  if (!fit_quadratic(points, stencil.weight)) return {};
  if (cubic_error(field, t, stencil) > kMostRingError) fit_cubic(points, stencil.weight);
  return stencil;
}

}  // namespace reflines
