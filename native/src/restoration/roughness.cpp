#include "restoration/roughness.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "base/parallel_failure.h"
#include "base/sort_unique.h"

namespace reflines {
namespace {

constexpr int kLeastNeighbours = 8;  // six coefficients, and something that they do not explain

}  // namespace

Roughness::Roughness(const PlanePositions& xy, const Triangles& F) : xy_(xy), neighbors_(xy.rows()) {
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      neighbors_[F(t, i)].push_back(F(t, (i + 1) % 3));
      neighbors_[F(t, (i + 1) % 3)].push_back(F(t, i));
    }
  }
}

Vector Roughness::of(const Vector& z) const {
  Vector result(z.size());
  run_parallel(static_cast<int>(z.size()), 256, [&](int v) { result(v) = at(v, z); });
  return result;
}

std::vector<int> Roughness::two_rings(int v) const {
  std::vector<int> result;
  for (const int near : neighbors_[v]) {
    result.push_back(near);
    result.insert(result.end(), neighbors_[near].begin(), neighbors_[near].end());
  }
  sort_unique(result);
  std::erase(result, v);
  return result;
}

double Roughness::at(int v, const Vector& z) const {
  const std::vector<int> ring = two_rings(v);
  if (static_cast<int>(ring.size()) < kLeastNeighbours) return 0.0;
  double size = 0;
  for (const int k : ring) size = std::max(size, (xy_.row(k) - xy_.row(v)).norm());
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  for (const int k : ring) {
    const Vector2 p = (xy_.row(k) - xy_.row(v)).transpose() / size;
    const Eigen::Matrix<double, 6, 1> row{1.0, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y()};
    A += row * row.transpose();
    b += (z(k) - z(v)) * row;
  }
  A.diagonal().array() += 1e-9 * A.trace();
  return -A.ldlt().solve(b)(0);
}

}  // namespace reflines
