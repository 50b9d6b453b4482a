#include "restoration/mirror_evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel_failure.h"
#include "geometry/cage_symmetry.h"
#include "restoration/designed_difference.h"
#include "restoration/disk_mean.h"

namespace reflines {
namespace {

constexpr double kPairTolerance = 1e-4, kDeepest = 3e-3;  // of the diagonal
constexpr double kPaired = 0.97;                          // of the vertices
constexpr double kNeighbourhood = 0.56;                   // of the length: over which roughness is compared
// Roughness counts up to this many root mean squares of the difference's own: fillets are rough on both sides.
constexpr double kRoughest = 2.0;
constexpr double kTaper = 0.28;  // of the length: beside designed differences corrections rise from nothing

PlanePositions plane_normals(const PlanePositions& xy, const PlanePositions& axes) {
  const PlanePositions centred = xy.rowwise() - xy.colwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(centred.transpose() * centred);
  PlanePositions result(2 + axes.rows(), 2);
  result.topRows(2) = eigen.eigenvectors().transpose();
  result.bottomRows(axes.rows()) = axes;
  return result;
}

// Partners across the line n . p = offset, itself where there is none; empty where too few vertices have one that is
// nearly as high.
IndexVector paired(const PlanePositions& xy, const Vector& z, double diagonal, const Vector2& n, double offset) {
  Positions flat(xy.rows(), 3);
  flat << xy, Vector::Zero(xy.rows());
  const MirrorPlane plane{Vector3(offset * n.x(), offset * n.y(), 0), Vector3(n.x(), n.y(), 0)};
  IndexVector partner = mirror_pairs(flat, plane, kPairTolerance * diagonal);
  Eigen::Index found = 0;
  for (Eigen::Index v = 0; v < partner.size(); ++v) {
    if (partner(v) < 0) {
      partner(v) = static_cast<int>(v);
    } else {
      found += std::abs(z(v) - z(partner(v))) < kDeepest * diagonal;
    }
  }
  return static_cast<double>(found) >= kPaired * static_cast<double>(partner.size()) ? partner : IndexVector();
}

// The distance of each height from a quadratic least-squares fit of the vertices within two edges: an operator that
// vanishes for quadratic surfaces on any mesh. The umbrella operator, applied twice, does not: where the diagonals of
// quads change sides, a dent of 4 mm was less rough than the clean surface beside it, and its mirror image got a
// quarter of it.
class Roughness {
 public:
  Roughness(const PlanePositions& xy, const Triangles& F) : xy_(xy), neighbors_(xy.rows()) {
    for (Eigen::Index t = 0; t < F.rows(); ++t) {
      for (int i = 0; i < 3; ++i) {
        neighbors_[F(t, i)].push_back(F(t, (i + 1) % 3));
        neighbors_[F(t, (i + 1) % 3)].push_back(F(t, i));
      }
    }
  }

  Vector of(const Vector& z) const {
    Vector result(z.size());
    ParallelFailure failure;
#pragma omp parallel for schedule(dynamic, 256)
    for (Eigen::Index v = 0; v < z.size(); ++v) failure.run([&] { result(v) = at(static_cast<int>(v), z); });
    failure.rethrow();
    return result;
  }

 private:
  static constexpr int kLeastNeighbours = 8;  // six coefficients, and something that they do not explain

  std::vector<int> two_rings(int v) const {
    std::vector<int> result;
    for (const int near : neighbors_[v]) {
      result.push_back(near);
      result.insert(result.end(), neighbors_[near].begin(), neighbors_[near].end());
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    result.erase(std::remove(result.begin(), result.end(), v), result.end());
    return result;
  }

  double at(int v, const Vector& z) const {
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

  const PlanePositions& xy_;
  std::vector<std::vector<int>> neighbors_;
};

// Finds the partners of vertices, however differently high they are.
IndexVector find_images(const PlanePositions& xy, const Vector& z, double diagonal, const PlanePositions& axes) {
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

}  // namespace

IndexVector find_mirror_partners(const PlanePositions& xy, const Vector& z, double diagonal,
                                 const PlanePositions& axes) {
  IndexVector result = find_images(xy, z, diagonal, axes);
  for (Eigen::Index v = 0; v < result.size(); ++v) {
    if (std::abs(z(v) - z(result(v))) >= kDeepest * diagonal) result(v) = static_cast<int>(v);
  }
  return result;
}

MirrorEvidence find_mirror_evidence(const PlanePositions& xy, const Vector& z, const Triangles& F, double diagonal,
                                    double length, const PlanePositions& axes) {
  MirrorEvidence result{find_images(xy, z, diagonal, axes), Vector::Zero(z.size()), Mask::Constant(z.size(), false)};
  if (result.partner.size() == 0) return result;
  const Vector difference = z - z(result.partner);
  if ((difference.array() == 0).all()) return result;
  const Roughness roughness(xy, F);
  const DiskMean mean(xy, Vector::Ones(z.size()), kNeighbourhood * length);
  const Vector unbounded = roughness.of(difference).cwiseAbs();
  const Vector most = kRoughest * mean.of(unbounded.cwiseAbs2()).cwiseSqrt();
  result.design = find_designed_differences(xy, F, difference, most / kRoughest, kDeepest * diagonal, length);
  const Vector spared =
      DiskMean(xy, Vector::Ones(z.size()), kTaper * length).of((!result.design).cast<double>().matrix());
  // Bounded as that of the heights is: else the peak of a dent would count in the difference only, and a quarter of it
  // would be taken for a bump of the other side.
  const Vector own = mean.of(unbounded.cwiseMin(most).cwiseAbs2());
  const Vector rough = roughness.of(z).cwiseAbs().cwiseMin(most).cwiseAbs2();
  // With z = s + a here and s + b there, a - b the difference: E(|rough(z)|^2 - |rough(z')|^2) = |rough(a)|^2 -
  // |rough(b)|^2, so that the share is 1 where only this side has a flaw, 0 where only the other has, half where both
  // do.
  const Vector excess = mean.of(rough - rough(result.partner).eval());
  for (Eigen::Index v = 0; v < z.size(); ++v) {
    const double share = own(v) > 0 ? std::clamp(0.5 + 0.5 * excess(v) / own(v), 0.0, 1.0) : 0.5;
    result.correction(v) = result.design(v) ? 0.0 : -share * spared(v) * difference(v);
    if (result.design(v)) result.partner(v) = static_cast<int>(v);
  }
  return result;
}

}  // namespace reflines
