#include "geometry/triangle_locator.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace reflines {
namespace {

constexpr double kOnBorder = -1e-12;
constexpr double kMargin = 1e-6;  // of a bin: more than kOnBorder and rounding beyond a triangle

struct BinRange {
  int left, right, bottom, top;
};

BinRange clamped_range(const Vector2& low, const Vector2& high, const Vector2& origin, const Vector2& cell, int columns,
                       int rows) {
  // Handles NaN and values out of the range of int, too.
  const auto index = [](double value, int count) {
    return value > 0 ? static_cast<int>(std::min(value, count - 1.0)) : 0;
  };
  return {index((low.x() - origin.x()) / cell.x(), columns), index((high.x() - origin.x()) / cell.x(), columns),
          index((low.y() - origin.y()) / cell.y(), rows), index((high.y() - origin.y()) / cell.y(), rows)};
}

// The limit of bins in which a triangle is listed, on average: sane meshes need about 4.
constexpr double kEntries = 64;

int bounded(double count) { return static_cast<int>(std::clamp(count, 1.0, 4096.0)); }

// Returns the range of x of the part of a triangle between two values of y.
std::pair<double, double> clip_to_slab(const std::array<Vector2, 3>& corner, double bottom, double top) {
  double left = INFINITY, right = -INFINITY;
  const auto take_in = [&](double x) { left = std::min(left, x), right = std::max(right, x); };
  for (int i = 0; i < 3; ++i) {
    const Vector2 &a = corner[i], &b = corner[(i + 1) % 3];
    if (a.y() >= bottom && a.y() <= top) take_in(a.x());
    for (const double y : {bottom, top}) {
      if ((a.y() < y) != (b.y() < y)) take_in(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  }
  return {left, right};
}

}  // namespace

// Calls take(row, first column, last column) for the bins that a triangle meets, and a margin of them for its border.
template <class Take>
void TriangleLocator::for_each_row(int t, const Take& take) const {
  const std::array<Vector2, 3> corner = {xy_.row(F_(t, 0)), xy_.row(F_(t, 1)), xy_.row(F_(t, 2))};
  const Vector2 low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
  const Vector2 high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
  const BinRange box = clamped_range(low, high, low_, cell_, columns_, rows_);
  if (box.left == box.right || box.bottom == box.top) {
    for (int row = box.bottom; row <= box.top; ++row) take(row, box.left, box.right);
    return;
  }
  const double margin = kMargin * cell_.y();
  for (int row = box.bottom; row <= box.top; ++row) {
    const double bottom = low_.y() + row * cell_.y() - margin;
    const auto [left, right] = clip_to_slab(corner, bottom, bottom + cell_.y() + 2 * margin);
    if (!(left <= right)) continue;
    const Vector2 aside(kMargin * cell_.x(), 0);
    const BinRange range =
        clamped_range(Vector2(left, bottom) - aside, Vector2(right, bottom) + aside, low_, cell_, columns_, rows_);
    take(row, std::max(range.left, box.left), std::min(range.right, box.right));
  }
}

TriangleLocator::TriangleLocator(const PlanePositions& xy, const Triangles& F) : xy_(xy), F_(F) {
  Eigen::AlignedBox2d box;
  for (const int v : F.reshaped()) box.extend(xy.row(v).transpose());
  if (box.isEmpty()) box.extend(Vector2(0.0, 0.0));
  low_ = box.min();
  extent_ = box.sizes().cwiseMax(1e-300);
  const double count = std::max<double>(1.0, static_cast<double>(F.rows())), aspect = extent_.x() / extent_.y();
  for (double bins = count;; bins /= 4) {  // coarser where many long triangles cross many bins each
    columns_ = bounded(std::sqrt(bins * aspect));
    rows_ = bounded(std::sqrt(bins / aspect));
    cell_ = extent_.cwiseQuotient(Vector2(columns_, rows_));
    if (count_entries() <= kEntries * count || bins < 1) break;
  }
  triangles_of_bin_ = make_incidence(static_cast<std::size_t>(columns_) * rows_, [&](const auto& take) {
    for (int t = 0; t < static_cast<int>(F_.rows()); ++t) {
      for_each_row(t, [&](int row, int left, int right) {
        for (int i = left; i <= right; ++i) take(static_cast<std::size_t>(row) * columns_ + i, t);
      });
    }
  });
}

double TriangleLocator::count_entries() const {
  double result = 0;
  for (int t = 0; t < static_cast<int>(F_.rows()); ++t) {
    for_each_row(t, [&](int, int left, int right) { result += right - left + 1; });
  }
  return result;
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
