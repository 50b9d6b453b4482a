#include "geometry/normal_fit.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/parallel_failure.h"
#include "base/sort_unique.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

// The singular values, relative to the largest, that are treated as zero: the fit is then the one of smallest
// coefficients.
constexpr double kRank = 1e-6;

// The angle in radians between normals at which a vertex hardly counts in a fit: a bend within one row of triangles (27
// degrees at the rounded edge of a car's bonnet) is no quadratic, and tilted the normals beside it by as much.
constexpr double kSameSurface = 0.2;

// The number of vertices below which another ring is added to a fit. A full quadratic through v has five coefficients,
// and corners of a border have few neighbours; with the ring their normals are of second order too (measured on a
// jittered cylinder: largest error 0.018 without, 0.002 with).
constexpr size_t kEnoughVertices = 9;

std::vector<int> fit_vertices(const Triangles& F, const Triangles& neighbors, const Incidence& triangles_of_vertex,
                              int v) {
  std::vector<int> triangles(triangles_of_vertex.items.begin() + triangles_of_vertex.begin(v),
                             triangles_of_vertex.items.begin() + triangles_of_vertex.end(v));
  std::vector<int> around;
  for (int ring = 0; ring < 3 && around.size() < kEnoughVertices; ++ring) {
    for (size_t k = 0, n = triangles.size(); k < n; ++k) {
      for (int i = 0; i < 3; ++i) {
        if (neighbors(triangles[k], i) >= 0) triangles.push_back(neighbors(triangles[k], i));
      }
    }
    sort_unique(triangles);
    around = list_vertices(F, triangles);
  }
  around.erase(std::remove(around.begin(), around.end(), v), around.end());
  if (!around.empty()) around.insert(around.begin(), v);
  return around;
}

// Returns the sum of the normals of the triangles around each vertex (#V x 3), each as long as twice the triangle's
// area.
Positions area_normals(const Positions& V, const Triangles& F, const Incidence& triangles_of_vertex) {
  Positions normals = Positions::Zero(V.rows(), 3);
#pragma omp parallel for schedule(dynamic, 1024)
  for (int v = 0; v < static_cast<int>(V.rows()); ++v) {
    for (int k = triangles_of_vertex.begin(v); k < triangles_of_vertex.end(v); ++k) {
      normals.row(v) += area_normal(V, F, triangles_of_vertex.items[k]).transpose();
    }
  }
  return normals;
}

// Returns the weight of a vertex with this area normal in a fit in the plane of `initial`.
double weight_of(const Vector3& area_normal, const Vector3& initial) {
  const double angle = std::atan2(initial.cross(area_normal).norm(), initial.dot(area_normal)) / kSameSurface;
  return area_normal.norm() * std::exp(-angle * angle);
}

}  // namespace

NormalFit::NormalFit(const Positions& V, const Triangles& F, double refit_angle)
    : F_(F), cosine_(std::cos(refit_angle)) {
  check_indices(V, F);
  triangles_of_vertex_ = vertex_triangles(F, static_cast<int>(V.rows()));
  const Triangles neighbors = edge_neighbors(F);
  std::vector<std::vector<int>> around(V.rows());
  const int count = static_cast<int>(V.rows());
  run_parallel(count, 256, [&](int v) { around[v] = fit_vertices(F, neighbors, triangles_of_vertex_, v); });
  stencil_.offset.push_back(0);
  for (const std::vector<int>& own : around) {
    stencil_.items.insert(stencil_.items.end(), own.begin(), own.end());
    stencil_.offset.push_back(static_cast<int>(stencil_.items.size()));
  }
  fits_.resize(V.rows());
  const Positions directions = area_normals(V, F, triangles_of_vertex_);
  run_parallel(count, 256, [&](int v) { fit(V, directions, v); });
}

void NormalFit::fit(const Positions& V, const Positions& area_normals, int v) {
  Fit& fit = fits_[v];
  const Vector3 own = area_normals.row(v);
  fit.initial = own.norm() > 0 ? own.normalized() : Vector3::UnitZ();
  fit.e1 = fit.initial.unitOrthogonal();
  fit.e2 = fit.initial.cross(fit.e1);
  const int K = stencil_.end(v) - stencil_.begin(v);
  fit.fitted = fit.initial;
  fit.slopes.setZero(2, K);
  if (K < 3) return;
  Eigen::Matrix<double, Eigen::Dynamic, 5> M(K - 1, 5);  // the quadratic passes through v itself
  Vector weight(K - 1);
  double size = 0;
  for (int k = 1; k < K; ++k) size = std::max(size, (V.row(stencil_.items[stencil_.begin(v) + k]) - V.row(v)).norm());
  if (size == 0) return;  // all lie on v
  for (int k = 1; k < K; ++k) {
    const Vector3 d = (V.row(stencil_.items[stencil_.begin(v) + k]) - V.row(v)).transpose() / size;
    const double x = d.dot(fit.e1), y = d.dot(fit.e2);
    weight(k - 1) = std::sqrt(weight_of(area_normals.row(stencil_.items[stencil_.begin(v) + k]), fit.initial));
    M.row(k - 1) << x, y, x * x, x * y, y * y;
  }
  weight /= std::max(weight.maxCoeff(), std::numeric_limits<double>::min());
  // Gives the coefficients of smallest norm, like the paper's singular value decomposition.
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, Eigen::Dynamic, 5>> decomposition;
  decomposition.setThreshold(kRank);
  decomposition.compute(weight.asDiagonal() * M);
  const Eigen::Matrix<double, 5, Eigen::Dynamic> coefficients = decomposition.pseudoInverse() * weight.asDiagonal();
  fit.slopes.rightCols(K - 1) = coefficients.topRows<2>() / size;
  fit.fitted = normal(V, v);
}

Vector3 NormalFit::normal(const Positions& V, int v) const {
  const Fit& fit = fits_[v];
  Vector2 slope = Vector2::Zero();
  for (int k = 1; k < static_cast<int>(fit.slopes.cols()); ++k) {
    const Vector3 d = V.row(stencil_.items[stencil_.begin(v) + k]) - V.row(v);
    slope += fit.slopes.col(k) * d.dot(fit.initial);
  }
  return (fit.initial - slope.x() * fit.e1 - slope.y() * fit.e2).normalized();
}

void NormalFit::check_count(const Positions& V) const {
  if (V.rows() == static_cast<Eigen::Index>(fits_.size())) return;
  throw InvalidInput("There are " + std::to_string(V.rows()) + " vertices but the fit was made for " +
                     std::to_string(fits_.size()) + "; make a new one.");
}

Positions NormalFit::kept_normals(const Positions& V) const {
  check_count(V);
  Positions N(V.rows(), 3);
#pragma omp parallel for schedule(dynamic, 1024)
  for (int v = 0; v < static_cast<int>(V.rows()); ++v) N.row(v) = normal(V, v);
  return N;
}

Positions NormalFit::normals(const Positions& V) {
  check_count(V);
  const Positions directions = area_normals(V, F_, triangles_of_vertex_);
  Positions N(V.rows(), 3);
  std::atomic<int> refitted = 0;
  run_parallel(static_cast<int>(V.rows()), 1024, [&](int v) {
    Vector3 n = normal(V, v);
    if (n.dot(fits_[v].fitted) < cosine_ && stencil_.end(v) > stencil_.begin(v)) {
      fit(V, directions, v);
      n = normal(V, v);
      ++refitted;
    }
    N.row(v) = n;
  });
  refit_count_ += refitted;
  return N;
}

}  // namespace reflines
