#include "targets/dense_heights.h"

#include <vector>

#include "geometry/triangle_locator.h"

namespace reflines {
namespace {

// Returns the triangles of height-field pieces: the others cannot be located in the image plane.
Triangles select_active_triangles(const RegionField& field) {
  std::vector<int> seen;
  for (int t = 0; t < field.F.rows(); ++t) {
    if (field.active(t)) seen.push_back(t);
  }
  return field.F(seen, Eigen::all);
}

}  // namespace

DenseHeights sample_dense_heights(const RegionField& region, const RegionField& dense, const Vector& heights) {
  const Triangles seen = select_active_triangles(dense);
  const TriangleLocator locator(dense.xy, seen);
  const int vertices = static_cast<int>(region.xy.rows());
  DenseHeights result{Vector::Zero(vertices), Vector::Zero(vertices)};
  for (int t = 0; t < region.F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) result.area(region.F(t, i)) += region.area(t) / 3.0;
  }
  for (int v = 0; v < vertices; ++v) {
    const Vector2 point = region.xy.row(v);
    const Location at = locator.locate(point);
    if (at.triangle < 0) result.area(v) = 0;
    for (int i = 0; i < 3 && at.triangle >= 0; ++i) {
      const int corner = seen(at.triangle, i);
      const double step = 0.5 * dense.vertex_slope.row(corner).dot(point.transpose() - dense.xy.row(corner));
      result.height(v) += at.barycentric(i) * (heights(corner) + step);
    }
  }
  return result;
}

}  // namespace reflines
