#include "native/geometry/locate.h"

#include <algorithm>
#include <cmath>

namespace reflines {
namespace {

constexpr double kOnBorder = -1e-12;

struct BinRange {
  int left, right, bottom, top;
};

BinRange clamped_range(const Vector2& low, const Vector2& high, const Vector2& origin, const Vector2& cell, int columns,
                       int rows) {
  const auto index = [](double value, int count) {
    return std::clamp(static_cast<int>(std::floor(value)), 0, count - 1);
  };
  return {index((low.x() - origin.x()) / cell.x(), columns), index((high.x() - origin.x()) / cell.x(), columns),
          index((low.y() - origin.y()) / cell.y(), rows), index((high.y() - origin.y()) / cell.y(), rows)};
}

}  // namespace

TriangleLocator::TriangleLocator(const PlanePositions& xy, const Triangles& F) : xy_(xy), F_(F) {
  low_ = Vector2::Constant(0);
  Vector2 high = low_;
  if (F.rows() > 0) low_ = high = xy.row(F(0, 0));
  for (int k = 0; k < F.size(); ++k) {
    low_ = low_.cwiseMin(xy.row(F.data()[k]).transpose());
    high = high.cwiseMax(xy.row(F.data()[k]).transpose());
  }
  const Vector2 extent = (high - low_).cwiseMax(1e-300);
  const double side = std::sqrt(extent.x() * extent.y() / std::max<double>(1.0, static_cast<double>(F.rows())));
  columns_ = std::clamp(static_cast<int>(extent.x() / side), 1, 4096);
  rows_ = std::clamp(static_cast<int>(extent.y() / side), 1, 4096);
  cell_ = extent.cwiseQuotient(Vector2(columns_, rows_));
  std::vector<std::vector<int>> bins(static_cast<size_t>(columns_) * rows_);
  for (int t = 0; t < static_cast<int>(F.rows()); ++t) {
    const Vector2 a = xy.row(F(t, 0)), b = xy.row(F(t, 1)), c = xy.row(F(t, 2));
    const BinRange range =
        clamped_range(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), low_, cell_, columns_, rows_);
    for (int j = range.bottom; j <= range.top; ++j) {
      for (int i = range.left; i <= range.right; ++i) bins[static_cast<size_t>(j) * columns_ + i].push_back(t);
    }
  }
  triangles_of_bin_.offset.push_back(0);
  for (const std::vector<int>& one : bins) {
    triangles_of_bin_.items.insert(triangles_of_bin_.items.end(), one.begin(), one.end());
    triangles_of_bin_.offset.push_back(static_cast<int>(triangles_of_bin_.items.size()));
  }
}

int TriangleLocator::bin(const Vector2& point) const {
  const BinRange range = clamped_range(point, point, low_, cell_, columns_, rows_);
  return range.bottom * columns_ + range.left;
}

Vector3 TriangleLocator::barycentric(int t, const Vector2& point) const {
  const Vector2 a = xy_.row(F_(t, 0)), ab = xy_.row(F_(t, 1)).transpose() - a, ac = xy_.row(F_(t, 2)).transpose() - a;
  const Vector2 ap = point - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  const double v = (ap.x() * ac.y() - ap.y() * ac.x()) / area, w = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
  return {1 - v - w, v, w};
}

Location TriangleLocator::locate(const Vector2& point) const {
  const int own = bin(point);
  for (int k = triangles_of_bin_.begin(own); k < triangles_of_bin_.end(own); ++k) {
    const Vector3 weights = barycentric(triangles_of_bin_.items[k], point);
    if (weights.minCoeff() >= kOnBorder) return {triangles_of_bin_.items[k], weights};
  }
  return {};
}

}  // namespace reflines
