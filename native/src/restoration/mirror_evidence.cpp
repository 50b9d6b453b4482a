#include "restoration/mirror_evidence.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/cage_symmetry.h"
#include "restoration/disk_mean.h"

namespace reflines {
namespace {

constexpr double kPairTolerance = 1e-4, kDeepest = 3e-3;  // of the diagonal
constexpr double kPaired = 0.97;                          // of the vertices
constexpr double kNeighbourhood = 0.56;                   // of the length: over which roughness is compared
// Roughness counts up to this many root mean squares of the difference's own: fillets are rough on both sides.
constexpr double kRoughest = 2.0;

PlanePositions plane_normals(const PlanePositions& xy, const PlanePositions& axes) {
  const PlanePositions centred = xy.rowwise() - xy.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(centred.transpose() * centred);
  PlanePositions result(2 + axes.rows(), 2);
  result.topRows(2) = eigen.eigenvectors().transpose();
  result.bottomRows(axes.rows()) = axes;
  return result;
}

// Partners across the line n . p = offset; empty where too few vertices have one.
IndexVector paired(const PlanePositions& xy, const Vector& z, double diagonal, const Vector2& n, double offset) {
  Positions flat(xy.rows(), 3);
  flat << xy, Vector::Zero(xy.rows());
  const MirrorPlane plane{Vector3(offset * n.x(), offset * n.y(), 0), Vector3(n.x(), n.y(), 0)};
  IndexVector partner = mirror_pairs(flat, plane, kPairTolerance * diagonal);
  Eigen::Index found = 0;
  for (Eigen::Index v = 0; v < partner.size(); ++v) {
    const bool good = partner(v) >= 0 && std::abs(z(v) - z(partner(v))) < kDeepest * diagonal;
    found += good;
    if (!good) partner(v) = static_cast<int>(v);
  }
  return static_cast<double>(found) >= kPaired * static_cast<double>(partner.size()) ? partner : IndexVector();
}

IndexVector find_partners(const PlanePositions& xy, const Vector& z, double diagonal, const PlanePositions& axes) {
  const PlanePositions normals = plane_normals(xy, axes);
  for (Eigen::Index k = 0; k < normals.rows(); ++k) {
    if (normals.row(k).norm() < 0.3) continue;
    const Vector2 n = normals.row(k).normalized();
    const Vector across = xy * n;
    for (const double offset : {(across.minCoeff() + across.maxCoeff()) / 2, across.mean()}) {
      IndexVector partner = paired(xy, z, diagonal, n, offset);
      if (partner.size() > 0) return partner;
    }
  }
  return {};
}

// The umbrella operator with weights of inverse edge length, applied twice: rows sum to zero, scale free.
class Roughness {
 public:
  Roughness(const PlanePositions& xy, const Triangles& F) : neighbors_(xy.rows()) {
    for (Eigen::Index t = 0; t < F.rows(); ++t) {
      for (int i = 0; i < 3; ++i) add(F(t, i), F(t, (i + 1) % 3), xy);
    }
    for (auto& list : neighbors_) {  // an inner edge was met from both sides
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  }
  Vector of(const Vector& z) const { return once(once(z)); }

 private:
  void add(int a, int b, const PlanePositions& xy) {
    const double weight = 1.0 / std::max((xy.row(a) - xy.row(b)).norm(), 1e-300);
    neighbors_[a].emplace_back(b, weight);
    neighbors_[b].emplace_back(a, weight);
  }
  Vector once(const Vector& z) const {
    Vector result = Vector::Zero(z.size());
    for (Eigen::Index v = 0; v < z.size(); ++v) {
      double sum = 0, weights = 0;
      for (const auto& [other, weight] : neighbors_[v]) {
        sum += weight * (z(other) - z(v));
        weights += weight;
      }
      if (weights > 0) result(v) = sum / weights;
    }
    return result;
  }
  std::vector<std::vector<std::pair<int, double>>> neighbors_;
};

}  // namespace

MirrorEvidence find_mirror_evidence(const PlanePositions& xy, const Vector& z, const Triangles& F, double diagonal,
                                    double length, const PlanePositions& axes) {
  MirrorEvidence result{find_partners(xy, z, diagonal, axes), Vector::Zero(z.size())};
  if (result.partner.size() == 0) return result;
  const Vector difference = z - z(result.partner);
  if ((difference.array() == 0).all()) return result;
  const Roughness roughness(xy, F);
  const DiskMean mean(xy, Vector::Ones(z.size()), kNeighbourhood * length);
  const Vector own = mean.of(roughness.of(difference).cwiseAbs2());
  const Vector most = kRoughest * own.cwiseSqrt();
  const Vector rough = roughness.of(z).cwiseAbs().cwiseMin(most).cwiseAbs2();
  // With z = s + a here and s + b there, a - b the difference: E(|rough(z)|^2 - |rough(z')|^2) = |rough(a)|^2 -
  // |rough(b)|^2, so that the share is 1 where only this side has a flaw, 0 where only the other has, half where both
  // do.
  const Vector excess = mean.of(rough - rough(result.partner).eval());
  for (Eigen::Index v = 0; v < z.size(); ++v) {
    const double share = own(v) > 0 ? std::clamp(0.5 + 0.5 * excess(v) / own(v), 0.0, 1.0) : 0.5;
    result.correction(v) = -share * difference(v);
  }
  return result;
}

}  // namespace reflines
