#include "restoration/curvature_variation.h"

#include <Eigen/LU>
#include <numbers>

#include "geometry/centroids.h"
#include "restoration/mean_plane.h"

namespace reflines {
namespace {

// Weight, relative to the others, of a gradient of 0: it determines what one or two neighbours on a line leave open.
constexpr double kUndetermined = 1e-3;

Stencils make_tensor_stencils(const HeightField& field) {
  Stencils result = make_stencils(field, StencilKind::kConsistent);
  result.hessian.col(1) *= std::numbers::sqrt2;
  return result;
}

// Returns a_e / d_e^2 = 3/2 |e|^2 / (A_1 + A_2).
EdgeWeights measure_edges(const HeightField& field) {
  EdgeWeights result = EdgeWeights::Zero(field.triangle_count(), 3);
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int other = field.neighbors(t, i);
      if (other < 0) continue;
      const auto edge = field.xy.row(field.F(t, (i + 2) % 3)) - field.xy.row(field.F(t, (i + 1) % 3));
      result(t, i) = 1.5 * edge.squaredNorm() / (field.area(t) + field.area(other));
    }
  }
  return result;
}

Eigen::Matrix<double, 2, 3> fit_slope(const HeightField& field, int t) {
  Eigen::Matrix<double, 2, 3> distance = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (int i = 0; i < 3; ++i) {
    const int other = field.neighbors(t, i);
    if (other < 0) continue;
    const Vector2 across = find_centroid(field.xy, field.F, other) - find_centroid(field.xy, field.F, t);
    distance.col(i) = across / across.squaredNorm();
    moments += distance.col(i) * across.transpose();
  }
  moments.diagonal().array() += kUndetermined * moments.trace() + 1e-300;
  return moments.inverse() * distance;
}

}  // namespace

CurvatureVariation::CurvatureVariation(const HeightField& field)
    : field_(field),
      stencils_(make_tensor_stencils(field)),
      entries_(stencils_, field.vertex_count()),
      shape_(measure_edges(field)),
      average_(field),
      form_(make_forms()),
      slope_(field.triangle_count(), 6) {
  for (int t = 0; t < field.triangle_count(); ++t) {
    const Eigen::Matrix<double, 2, 3> slope = fit_slope(field, t);
    slope_.row(t) = Eigen::Map<const Eigen::Matrix<double, 1, 6>>(slope.data());
  }
}

// Returns the matrices by averaged slopes, lest noise of the vertices change the forms from triangle to triangle.
std::vector<Eigen::Matrix3d> CurvatureVariation::make_forms() const {
  TriangleDerivatives u;
  apply_stencils(stencils_, field_.z, u);
  const PlaneVectors slope = average_.of(u.leftCols<2>(), Mask::Constant(u.rows(), true));
  std::vector<Eigen::Matrix3d> result;
  result.reserve(u.rows());
  for (const auto& own : slope.rowwise()) {
    const TangentMap map = find_tangent_map(own);
    result.emplace_back(map.lift * substitute(map.stretch.inverse()));
  }
  return result;
}

TriangleFields CurvatureVariation::read_hessians(const Vector& z) const {
  TriangleFields result(field_.triangle_count(), 3);
#pragma omp parallel for schedule(static) if (field_.triangle_count() > kWorthThreads)
  for (int t = 0; t < field_.triangle_count(); ++t) result.row(t) = apply_stencil(stencils_, t, z).tail<3>();
  return result;
}

TriangleFields CurvatureVariation::average(const TriangleFields& hessian) const {
  const Mask all = Mask::Constant(hessian.rows(), true);
  TriangleFields result(hessian.rows(), 3);
  result.leftCols<2>() = average_.of(hessian.leftCols<2>(), all);
  result.rightCols<2>() = average_.of(hessian.rightCols<2>(), all);
  return result;
}

Eigen::MatrixXd CurvatureVariation::read_tensors(const TriangleFields& hessian) const {
  Eigen::MatrixXd result(field_.triangle_count(), 3);
#pragma omp parallel for schedule(static) if (field_.triangle_count() > kWorthThreads)
  for (int t = 0; t < field_.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> slope = differentiate(t, [&](int k) { return hessian.row(k); });
    result.row(t) << slope.col(0).squaredNorm(), slope.col(0).dot(slope.col(1)), slope.col(1).squaredNorm();
  }
  return result;
}

Vector CurvatureVariation::differentiate(const Vector& z, const EdgeWeights& scaled) const {
  TriangleFields form = read_hessians(z);
  for (int t = 0; t < form.rows(); ++t) form.row(t) *= form_[t];
  Vector products(static_cast<Eigen::Index>(stencils_.vertex.size())), result;
#pragma omp parallel for schedule(static) if (field_.triangle_count() > kWorthThreads)
  for (int t = 0; t < field_.triangle_count(); ++t) {
    Vector3 change = Vector3::Zero();
    for (int i = 0; i < 3; ++i) {
      const int other = field_.neighbors(t, i);
      if (other >= 0) change += scaled(t, i) * (form.row(t) - form.row(other)).transpose();
    }
    change = form_[t] * change;
    for (int e = stencils_.offset[t]; e < stencils_.offset[t + 1]; ++e)
      products(e) = stencils_.hessian.row(e).dot(change);
  }
  sum_products(entries_, products, result);
  return result;
}

}  // namespace reflines
