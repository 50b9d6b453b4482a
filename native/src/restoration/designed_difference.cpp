#include "restoration/designed_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/mesh.h"
#include "reflection/weighted_median.h"
#include "restoration/disk_mean.h"

namespace reflines {
namespace {

// Slope from which on a difference is design, that of dents of 1.8 per mille of the diagonal, 5 % of it wide. Of 0.02,
// 0.03 and 0.045, on symmetric meshes: of dents of 1.2 per mille of a designed bonnet 0.74, 0.18 and 0.18 is left, of
// those of 1.8 per mille 0.77, 0.74 and 0.16. A handle, louvres, a scoop and a badge of 2.3 per mille on one side are
// kept with each, a badge of 0.9 per mille with 0.02 alone.
constexpr double kSteepest = 0.045;

// A slope up to this many times the region's median is everywhere, and so a flaw. Noise of 3 % of an edge leaves 0.30
// of itself with it and 0.67 without; 2.5, 4 and 6 give the same on all these panels.
constexpr double kTypical = 4.0;

// Radius, relative to the length, over which slopes and heights are averaged, so that noise does not decide.
constexpr double kAveraged = 0.28;

// A steep place counts where the difference is higher than it is rough around there, by the mean square. Of noise, also
// of a panel of whose vertices few have any, so that the median tells nothing, steep places are 0.2 to 0.4 times as
// high as rough; of designs 2 to 13 times. Without it such noise took the evidence from 400 of 2,100 vertices of a
// roof, and 0.25 of the noise was left instead of 0.18; of a bonnet 0.91 instead of 0.66.
constexpr double kAboveRoughness = 1.0;

// A region ends where the difference falls to this share of its steep part's, or to so many medians of the whole.
constexpr double kSkirt = 0.05, kFloor = 2.0;

// Returns the gradient at each vertex (#V x 2), the mean of its triangles' by area.
PlanePositions vertex_gradients(const PlanePositions& xy, const Triangles& F, const Vector& z) {
  PlanePositions result = PlanePositions::Zero(xy.rows(), 2);
  Vector area = Vector::Zero(xy.rows());
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Vector2 b = xy.row(F(t, 1)) - xy.row(F(t, 0)), c = xy.row(F(t, 2)) - xy.row(F(t, 0));
    const double doubled = b.x() * c.y() - b.y() * c.x();
    const double up = z(F(t, 1)) - z(F(t, 0)), on = z(F(t, 2)) - z(F(t, 0));
    const Vector2 gradient = Vector2(up * c.y() - on * b.y(), on * b.x() - up * c.x()) * (doubled < 0 ? -1.0 : 1.0);
    for (int i = 0; i < 3; ++i) {
      result.row(F(t, i)) += gradient;
      area(F(t, i)) += std::abs(doubled);
    }
  }
  for (Eigen::Index v = 0; v < area.size(); ++v) {
    if (area(v) > 0) result.row(v) /= area(v);
  }
  return result;
}

// Marks the vertices that are connected to `seed` by heights of its sign above `level`.
void grow(const Triangles& F, const Incidence& triangles, const Vector& height, int seed, double level, Mask& marked) {
  std::vector<int> front{seed};
  marked(seed) = true;
  while (!front.empty()) {
    const int v = front.back();
    front.pop_back();
    for (int k = triangles.begin(v); k < triangles.end(v); ++k) {
      for (int i = 0; i < 3; ++i) {
        const int near = F(triangles.items[k], i);
        if (marked(near) || height(near) * std::copysign(1.0, height(seed)) <= level) continue;
        marked(near) = true;
        front.push_back(near);
      }
    }
  }
}

}  // namespace

Mask find_designed_differences(const PlanePositions& xy, const Triangles& F, const Vector& difference,
                               const Vector& roughness, double deepest, double length) {
  const Vector one = Vector::Ones(difference.size());
  Eigen::MatrixXd columns(difference.size(), 3);
  columns << difference, vertex_gradients(xy, F, difference);
  columns = DiskMean(xy, one, kAveraged * length).of_columns(columns);
  const Vector height = columns.col(0), size = height.cwiseAbs(), slope = columns.rightCols(2).rowwise().norm();
  const double steepest = std::max(kSteepest, kTypical * weighted_median(slope, one));
  const double floor = kFloor * weighted_median(size, one);
  std::vector<int> seeds;
  for (int v = 0; v < size.size(); ++v) {
    const bool steep = slope(v) > steepest && size(v) > kAboveRoughness * roughness(v);
    if (steep || std::abs(difference(v)) > deepest) seeds.push_back(v);
  }
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return size(a) > size(b); });
  Mask result = Mask::Constant(size.size(), false);
  const Incidence triangles = vertex_triangles(F, static_cast<int>(size.size()));
  for (const int seed : seeds) {
    if (!result(seed)) grow(F, triangles, height, seed, std::max(floor, kSkirt * size(seed)), result);
  }
  return result;
}

}  // namespace reflines
