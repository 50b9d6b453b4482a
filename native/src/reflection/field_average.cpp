#include "reflection/field_average.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace reflines {
namespace {

constexpr int kFewest = 4;  // triangles for a fit of three coefficients
// The ratio of smallest to largest pivot of the moments below which the centroids lie on a line.
constexpr double kOnLine = 1e-8;

Vector2 centroid(const HeightField& field, int t) {
  Vector2 sum = Vector2::Zero();
  for (int i = 0; i < 3; ++i) sum += field.xy.row(field.F(t, i)).transpose();
  return sum / 3.0;
}

// Marks the vertices that are surrounded by their triangles.
Mask find_surrounded(const HeightField& field) {
  Mask result(field.vertex_count());
  const Incidence& around = field.triangles_of_vertex;
  for (int v = 0; v < field.vertex_count(); ++v) result(v) = around.end(v) - around.begin(v) >= kFewest;
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (field.neighbors(t, i) < 0) result(field.F(t, (i + 1) % 3)) = result(field.F(t, (i + 2) % 3)) = false;
    }
  }
  return result;
}

// Computes the value at v of the fit as weights of the triangles around it; returns false where there is none.
bool fit(const HeightField& field, int v, double* weight) {
  const Incidence& around = field.triangles_of_vertex;
  const int count = around.end(v) - around.begin(v);
  Eigen::Matrix3Xd P = Eigen::Matrix3Xd::Ones(3, count);
  for (int k = 0; k < count; ++k) {
    P.col(k).tail<2>() = centroid(field, around.items[around.begin(v) + k]) - field.xy.row(v).transpose();
  }
  P.bottomRows<2>() /= P.bottomRows<2>().cwiseAbs().maxCoeff();
  const Eigen::LDLT<Eigen::Matrix3d> moments(P * P.transpose());
  if (!(moments.vectorD().minCoeff() > kOnLine * moments.vectorD().maxCoeff())) return false;
  Eigen::Map<Eigen::RowVectorXd>(weight, count) = moments.solve(Vector3::UnitX()).transpose() * P;
  return true;
}

}  // namespace

FieldAverage::FieldAverage(const HeightField& field)
    : field_(field), weight_(field.triangles_of_vertex.items.size()), fitted_(find_surrounded(field)) {
#pragma omp parallel for schedule(static) if (field.vertex_count() > kWorthThreads)
  for (int v = 0; v < field_.vertex_count(); ++v) {
    if (fitted_(v)) fitted_(v) = fit(field_, v, weight_.data() + field_.triangles_of_vertex.begin(v));
  }
}

PlaneVectors FieldAverage::of(const PlaneVectors& values, const Mask& counts) const {
  const Incidence& around = field_.triangles_of_vertex;
  PlaneVectors at_vertex = PlaneVectors::Zero(field_.vertex_count(), 2), result(values.rows(), 2);
  Mask fitted = fitted_;
#pragma omp parallel if (values.rows() > kWorthThreads)
  {
#pragma omp for schedule(static)
    for (int v = 0; v < field_.vertex_count(); ++v) {
      for (int k = around.begin(v); fitted(v) && k < around.end(v); ++k) {
        fitted(v) = counts(around.items[k]);
        at_vertex.row(v) += weight_[k] * values.row(around.items[k]);
      }
    }
#pragma omp for schedule(static)
    for (int t = 0; t < static_cast<int>(values.rows()); ++t) {
      result.row(t).setZero();
      for (int i = 0; counts(t) && i < 3; ++i) {
        const int v = field_.F(t, i);
        const auto& source = fitted(v) ? at_vertex : values;
        result.row(t) += source.row(fitted(v) ? v : t) / 3.0;
      }
    }
  }
  return result;
}

}  // namespace reflines
