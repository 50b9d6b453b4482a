#include "restoration/designed_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/mesh.h"
#include "reflection/weighted_median.h"
#include "restoration/disk_mean.h"
#include "restoration/press_rules.h"
#include "restoration/triangle_slopes.h"

namespace reflines {
namespace {

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
  columns << difference, find_vertex_gradients(xy, F, difference);
  columns = DiskMean(xy, one, kRules.symmetry.averaged * length).of_columns(columns);
  const Vector height = columns.col(0), size = height.cwiseAbs(), slope = columns.rightCols(2).rowwise().norm();
  const double floor = kRules.symmetry.floor * weighted_median(size, one);
  std::vector<int> seeds;
  for (int v = 0; v < size.size(); ++v) {
    const bool steep = slope(v) > kRules.symmetry.design_slope && size(v) > roughness(v);
    if (steep || std::abs(difference(v)) > deepest) seeds.push_back(v);
  }
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return size(a) > size(b); });
  Mask result = Mask::Constant(size.size(), false);
  const Incidence triangles = vertex_triangles(F, static_cast<int>(size.size()));
  for (const int seed : seeds) {
    if (!result(seed)) grow(F, triangles, height, seed, std::max(floor, kRules.symmetry.skirt * size(seed)), result);
  }
  return result;
}

}  // namespace reflines
