#include "reflines/rasterize.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <utility>

#include "geometry/mesh.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr double kFarthest = 1e8;  // pixels: what a coordinate is cut to, so that it has a row and a column

// Draws into a raster, with how near what is drawn lies to the viewer.
class Drawing {
 public:
  Drawing(int width, int height)
      : nearness_(Eigen::MatrixXd::Constant(height, width, -std::numeric_limits<double>::infinity())) {
    result_.triangle.setConstant(height, width, -1);
    result_.second.setZero(height, width);
    result_.third.setZero(height, width);
  }

  void draw(int t, const Vector3& a, const Vector3& b, const Vector3& c) {
    const double twice_area = cross(b - a, c - a);
    if (twice_area == 0) return;
    const auto [left, right] = range({a.x(), b.x(), c.x()}, nearness_.cols());
    const auto [top, bottom] = range({a.y(), b.y(), c.y()}, nearness_.rows());
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const Vector3 p(x + 0.5, y + 0.5, 0);
        const double second = cross(p - a, c - a) / twice_area, third = cross(b - a, p - a) / twice_area;
        if (second < 0 || third < 0 || second + third > 1) continue;
        const double near = a.z() + second * (b.z() - a.z()) + third * (c.z() - a.z());
        if (near <= nearness_(y, x)) continue;
        nearness_(y, x) = near;
        result_.triangle(y, x) = t;
        result_.second(y, x) = static_cast<float>(second);
        result_.third(y, x) = static_cast<float>(third);
      }
    }
  }

  const Raster& result() const { return result_; }

 private:
  static double cross(const Vector3& u, const Vector3& v) { return u.x() * v.y() - u.y() * v.x(); }

  // Returns the pixels, first and one after the last, whose middles lie between these coordinates.
  static std::pair<int, int> range(std::initializer_list<double> coordinates, Eigen::Index count) {
    const auto [low, high] = std::minmax(coordinates);
    const auto cut = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(count))); };
    return {cut(std::ceil(low - 0.5)), cut(std::floor(high - 0.5) + 1)};
  }

  Raster result_;
  Eigen::MatrixXd nearness_;
};

}  // namespace

Raster rasterize(const Positions& points, const Triangles& F, int width, int height) {
  if (width < 1 || height < 1 || static_cast<double>(width) * height > kMostPixels)
    throw InvalidInput("A picture needs a width and a height of one pixel or more, and 67 million pixels at most.");
  check_indices(points, F);
  if (!points.allFinite()) throw InvalidInput("A point of the picture is no finite number.");
  Drawing drawing(width, height);
  const Positions cut = points.cwiseMax(-kFarthest).cwiseMin(kFarthest);
  for (int t = 0; t < static_cast<int>(F.rows()); ++t)
    drawing.draw(t, cut.row(F(t, 0)), cut.row(F(t, 1)), cut.row(F(t, 2)));
  return drawing.result();
}

}  // namespace reflines
