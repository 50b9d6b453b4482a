#include "targets/smooth_change.h"

#include <Eigen/Dense>
#include <tuple>

namespace reflines {
namespace {

constexpr double kDefinite = 1e-8;
// The ridge, relative to the largest diagonal entry, of the values' system: places in one triangle may depend on each
// other.
constexpr double kRidge = 1e-11;

// The Laplacian of the part's hat functions, integrated around each vertex of the surface, and the vertices' areas.
struct Laplacian {
  SparseMatrix L;  // #V x #unknowns
  Vector area;     // #V
};

Laplacian assemble_laplacian(const RegionField& field, const IndexVector& unknown, int count) {
  Laplacian result{SparseMatrix(field.xy.rows(), count), Vector::Zero(field.xy.rows())};
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0; t < field.F.rows(); ++t) {
    if (!field.active(t)) continue;
    for (int i = 0; i < 3; ++i) {
      const int a = field.F(t, i), b = field.F(t, (i + 1) % 3), c = field.F(t, (i + 2) % 3);
      result.area(a) += field.area(t) / 3;
      const Vector2 ab = field.xy.row(b) - field.xy.row(a), ac = field.xy.row(c) - field.xy.row(a);
      const double half_cotangent = 0.25 * ab.dot(ac) / field.area(t);
      for (const auto& [row, column, sign] : {std::tuple(b, b, 1), {b, c, -1}, {c, c, 1}, {c, b, -1}}) {
        if (unknown(column) >= 0) entries.emplace_back(row, unknown(column), sign * half_cotangent);
      }
    }
  }
  result.L.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace

SmoothChange::SmoothChange(const RegionField& field, const Mask& part, double length, const Vector& firmness,
                           const SpdFactorize& factorize)
    : field_(field), part_(part), unknown_(IndexVector::Constant(part.size(), -1)) {
  for (int v = 0; v < part.size(); ++v) {
    if (!part(v)) continue;
    unknown_(v) = static_cast<int>(vertex_.size());
    vertex_.push_back(v);
  }
  const int count = static_cast<int>(vertex_.size());
  const Laplacian laplacian = assemble_laplacian(field, unknown_, count);
  const Vector inverse = (laplacian.area.array() > 0).select(laplacian.area.cwiseInverse(), 0.0);
  const SparseMatrix scaled = inverse.asDiagonal() * laplacian.L;
  SparseMatrix system = laplacian.L.transpose() * scaled;
  const double unit = 1 / (length * length * length * length);
  for (int k = 0; k < count; ++k) {
    system.coeffRef(k, k) += (kDefinite + firmness(vertex_[k])) * unit * laplacian.area(vertex_[k]);
  }
  solve_ = factorize(system.triangularView<Eigen::Lower>());
}

Vector SmoothChange::interpolate(const std::vector<Location>& at, const Vector& values) const {
  Vector result = Vector::Zero(part_.size());
  if (values.isZero(0.0)) return result;
  const auto places = static_cast<Eigen::Index>(at.size()), count = static_cast<Eigen::Index>(vertex_.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, places), influence(count, places);
  for (Eigen::Index k = 0; k < places; ++k) {
    for (int i = 0; i < 3; ++i) {
      const int own = unknown_(field_.F(at[k].triangle, i));
      if (own >= 0) rows(own, k) = at[k].barycentric(i);
    }
    Vector column = rows.col(k);
    solve_(column);
    influence.col(k) = column;
  }
  Eigen::MatrixXd system = rows.transpose() * influence;
  system.diagonal().array() += kRidge * system.diagonal().maxCoeff();
  const Vector c = influence * system.ldlt().solve(values);
  for (Eigen::Index k = 0; k < count; ++k) result(vertex_[k]) = c(k);
  return result;
}

}  // namespace reflines
