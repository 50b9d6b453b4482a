#include "geometry/view_visibility.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace reflines {
namespace {

constexpr double kMostCells = 4e6;

using Box = Eigen::AlignedBox2d;

Box find_box(const Positions& seen, const Triangles& F, Eigen::Index t) {
  Box box;
  for (int i = 0; i < 3; ++i) box.extend(Vector2(seen(F(t, i), 0), seen(F(t, i), 1)));
  return box;
}

Positions turn(const Positions& V, const Vector3& view) {
  const Vector3 x = view.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << x, view.cross(x), view;
  return V * axes;
}

}  // namespace

ViewVisibility::ViewVisibility(const Positions& V, const Triangles& F, const Vector3& view)
    : F_(F), seen_(turn(V, view)) {
  Box all;
  double size = 0;  // of a triangle, in the mean
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Box box = find_box(seen_, F, t);
    all.extend(box);
    size += box.sizes().maxCoeff() / static_cast<double>(F.rows());
  }
  if (F.rows() == 0) return;
  low_ = all.min();
  const Vector2 extent = all.sizes();
  cell_ = std::max({size, std::sqrt(extent.prod() / kMostCells), extent.maxCoeff() / kMostCells, 1e-300});
  columns_ = 1 + static_cast<int>(extent.x() / cell_);
  rows_ = 1 + static_cast<int>(extent.y() / cell_);
  list_triangles();
}

// Lists the triangles whose bounding boxes meet each cell.
void ViewVisibility::list_triangles() {
  std::vector<int>& offset = triangles_of_cell_.offset;
  offset.assign(static_cast<size_t>(columns_) * rows_ + 1, 0);
  const auto visit = [&](const auto& take) {
    for (int t = 0; t < static_cast<int>(F_.rows()); ++t) {
      const Box box = find_box(seen_, F_, t);
      const auto [left, bottom] = cell_of(box.min());
      const auto [right, top] = cell_of(box.max());
      for (int row = bottom; row <= top; ++row) {
        for (int column = left; column <= right; ++column) take(static_cast<size_t>(row) * columns_ + column, t);
      }
    }
  };
  visit([&](size_t cell, int) { ++offset[cell + 1]; });
  for (size_t cell = 1; cell < offset.size(); ++cell) offset[cell] += offset[cell - 1];
  triangles_of_cell_.items.resize(offset.back());
  std::vector<int> next(offset.begin(), offset.end() - 1);
  visit([&](size_t cell, int t) { triangles_of_cell_.items[next[cell]++] = t; });
}

std::pair<int, int> ViewVisibility::cell_of(const Vector2& point) const {
  const Vector2 place = (point - low_) / cell_;
  return {static_cast<int>(std::clamp(place.x(), 0.0, columns_ - 1.0)),
          static_cast<int>(std::clamp(place.y(), 0.0, rows_ - 1.0))};
}

// Returns true where triangle t lies over a point, higher than that.
bool ViewVisibility::covers(int t, const Vector3& point) const {
  const Vector3 a = seen_.row(F_(t, 0)), b = seen_.row(F_(t, 1)), c = seen_.row(F_(t, 2));
  if (std::max({a.z(), b.z(), c.z()}) <= point.z()) return false;
  const Vector3 ab = b - a, ac = c - a, ap = point - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  if (area == 0) return false;  // seen from the side
  const double v = (ap.x() * ac.y() - ap.y() * ac.x()) / area, w = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
  return v >= 0 && w >= 0 && v + w <= 1 && v * ab.z() + w * ac.z() > ap.z();
}

bool ViewVisibility::touches(int t, int other) const {
  for (int i = 0; i < 3; ++i) {
    if ((F_.row(t).array() == F_(other, i)).any()) return true;
  }
  return false;
}

bool ViewVisibility::is_hidden(int t, double clearance) const {
  Vector3 middle = (seen_.row(F_(t, 0)) + seen_.row(F_(t, 1)) + seen_.row(F_(t, 2))) / 3;
  middle.z() += clearance;
  const auto [column, row] = cell_of(middle.head<2>());
  const int cell = row * columns_ + column;
  for (int k = triangles_of_cell_.begin(cell); k < triangles_of_cell_.end(cell); ++k) {
    const int other = triangles_of_cell_.items[k];
    if (covers(other, middle) && !touches(t, other)) return true;
  }
  return false;
}

double ViewVisibility::facing(int t) const {
  const Vector3 a = seen_.row(F_(t, 0)), b = seen_.row(F_(t, 1)), c = seen_.row(F_(t, 2));
  return (b - a).cross(c - a).normalized().z();
}

}  // namespace reflines
