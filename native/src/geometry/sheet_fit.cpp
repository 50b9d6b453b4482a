#include "geometry/sheet_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/sort_unique.h"
#include "geometry/mesh.h"

namespace reflines {
namespace {

constexpr double kTurned = 0.5;       // cosine of 60 degrees
constexpr size_t kEnough = 18;        // vertices; a cubic has ten coefficients
constexpr int kMostLayers = 8;        // of triangles around the first
constexpr double kDetermined = 1e-3;  // the pivot, relative to the largest, below which a polynomial is not determined

// Adds the triangles across the edges of the last layer, where they face the same way; returns the new layer.
std::vector<int> grow(const NeighborSheets& sheets, const Vector3& normal, const std::vector<int>& layer,
                      std::vector<int>& all) {
  std::vector<int> next;
  for (const int t : layer) {
    for (const int other : sheets.neighbors.row(t)) {
      if (other >= 0 && !std::binary_search(all.begin(), all.end(), other) &&
          unit_normal(sheets.V, sheets.F, other).dot(normal) > kTurned)
        next.push_back(other);
    }
  }
  sort_unique(next);
  all.insert(all.end(), next.begin(), next.end());
  std::sort(all.begin(), all.end());
  return next;
}

// Grows layers around triangle t until they have enough vertices, and by one or two more, since a layer of triangles
// across edges is narrower at its corners.
std::vector<int> gather_vertices(const NeighborSheets& sheets, int t, const Vector3& normal) {
  std::vector<int> all = {t}, layer = all, vertices = list_vertices(sheets.F, all);
  for (int k = 0, more = 2; k < kMostLayers && more > 0 && !layer.empty(); ++k) {
    more -= vertices.size() >= kEnough;
    layer = grow(sheets, normal, layer, all);
    vertices = list_vertices(sheets.F, all);
  }
  return vertices;
}

using Quadratic = Eigen::Matrix<double, 6, 1>;

// Fits a polynomial of this degree to heights, with a weight each; returns its coefficients 1, x, y, xx, xy, yy, or
// nothing.
std::optional<Quadratic> fit(const PlanePositions& points, const Vector& heights, const Vector& weight, int degree) {
  const Eigen::ArrayXd x = points.col(0).array(), y = points.col(1).array();
  Eigen::MatrixXd M(points.rows(), degree == 3 ? 10 : 6);
  if (M.rows() < M.cols()) return std::nullopt;
  M.leftCols(6) << Eigen::ArrayXd::Ones(x.size()), x, y, x * x, x * y, y * y;
  if (degree == 3) M.rightCols(4) << x * x * x, x * x * y, x * y * y, y * y * y;
  M = weight.asDiagonal() * M;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(kDetermined);
  if (decomposition.compute(M).rank() < M.cols()) return std::nullopt;
  return decomposition.solve(weight.cwiseProduct(heights)).eval().head<6>();
}

}  // namespace

std::optional<SheetPoint> fit_sheet(const NeighborSheets& sheets, int t, const Vector3& at, const Vector3& normal) {
  const std::vector<int> vertices = gather_vertices(sheets, t, normal);
  const Vector3 x = normal.unitOrthogonal(), y = normal.cross(x);
  PlanePositions points(static_cast<Eigen::Index>(vertices.size()), 2);
  Vector heights(points.rows());
  for (Eigen::Index k = 0; k < heights.size(); ++k) {
    const Vector3 d = sheets.V.row(vertices[k]).transpose() - at;
    points.row(k) << d.dot(x), d.dot(y);
    heights(k) = d.dot(normal);
  }
  const double size = points.rowwise().norm().maxCoeff();
  if (!(size > 0)) return std::nullopt;
  points /= size;
  const Vector weight = (1.0 - 0.98 * points.rowwise().squaredNorm().array()).matrix();
  for (const int degree : {3, 2}) {
    if (const std::optional<Quadratic> c = fit(points, heights, weight, degree)) {
      const Vector2 slope = c->segment<2>(1) / size;
      const Vector3 second = Vector3(2 * (*c)(3), (*c)(4), 2 * (*c)(5)) / (size * size);
      return SheetPoint{
          at + (*c)(0) * normal, (normal - slope.x() * x - slope.y() * y).normalized(), x, y, slope, second};
    }
  }
  return std::nullopt;
}

}  // namespace reflines
