// Second derivatives from the vertices of the triangles that touch T: the weights of smallest norm that are exact on
// quadratics. They exist wherever the ring does not lie on a conic: on borders, at valence three, on unstable six-point
// stencils.
#include <Eigen/Cholesky>
#include <algorithm>

#include "geometry/stencil.h"

namespace reflines {
namespace {

// The ratio of the smallest to the largest pivot of the moment matrix below which the ring is (nearly) on a conic. The
// matrix holds squares, so this is a ratio of 1e-5 between the points' own singular values.
constexpr double kOnConic = 1e-10;

// The largest number of vertices read around one corner: all of them up to valence 17. A pole with n spokes would
// otherwise put n weights on each of its n triangles and n^4 into their Hessian (n = 1024: 100 s, now 0.5 s). Spread
// evenly around the corner they are as exact as all (of 256 spokes: lines off by 0.020 a length, with all 0.024) and as
// steady (1.7 times the noise of all); the nearest 48, and the 8 next on both sides, lie almost on a line there (390
// and 50 times).
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
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  std::vector<int> vertex = {field.F(t, 0), field.F(t, 1), field.F(t, 2)};
  for (int v : around) {
    if (std::find(vertex.begin(), vertex.begin() + 3, v) == vertex.begin() + 3) vertex.push_back(v);
  }
  return vertex;
}

// Returns rows 1, x, y, x^2/2, xy, y^2/2 at the ring's points, relative to T's centre in units of `size`.
Eigen::Matrix<double, 6, Eigen::Dynamic> monomials(const HeightField& field, int t, const std::vector<int>& vertex,
                                                   double& size) {
  Vector2 centre = Vector2::Zero();
  for (int i = 0; i < 3; ++i) centre += field.xy.row(field.F(t, i)).transpose() / 3.0;
  size = 0;
  for (int v : vertex) size = std::max(size, (field.xy.row(v).transpose() - centre).norm());
  Eigen::Matrix<double, 6, Eigen::Dynamic> P(6, vertex.size());
  for (size_t k = 0; k < vertex.size(); ++k) {
    const Vector2 p = (field.xy.row(vertex[k]).transpose() - centre) / size;
    P.col(k) << 1.0, p.x(), p.y(), 0.5 * p.x() * p.x(), p.x() * p.y(), 0.5 * p.y() * p.y();
  }
  return P;
}

}  // namespace

HessianStencil ring_hessian(const HeightField& field, int t) {
  HessianStencil stencil;
  const std::vector<int> vertex = ring(field, t);
  if (vertex.size() < 6) return stencil;
  double size = 0;
  const Eigen::Matrix<double, 6, Eigen::Dynamic> P = monomials(field, t, vertex, size);
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> moments(P * P.transpose());
  const auto pivots = moments.vectorD();
  if (pivots.minCoeff() < kOnConic * pivots.maxCoeff()) return stencil;
  Eigen::Matrix<double, 6, 3> wanted = Eigen::Matrix<double, 6, 3>::Zero();
  wanted.bottomRows<3>().setIdentity();
  stencil.weight = (P.transpose() * moments.solve(wanted)).transpose() / (size * size);
  stencil.vertex = vertex;
  return stencil;
}

}  // namespace reflines
