#include "native/geometry/crease.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace reflines {
namespace {

constexpr double kChainShare = 0.25;   // of the crease angle: edges of a chain
constexpr double kChainMedian = 25.0;  // times the median edge
constexpr double kChainReach = 0.08;   // of the region's extent

double median_bend(const EdgeBends& bend, const Triangles& neighbors) {
  std::vector<double> inner;
  for (int t = 0; t < neighbors.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) > t) inner.push_back(bend(t, i));
    }
  }
  if (inner.empty()) return 0.0;
  std::nth_element(inner.begin(), inner.begin() + inner.size() / 2, inner.end());
  return inner[inner.size() / 2];
}

int root(std::vector<int>& parent, int v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

// For every vertex the extent of the chain of marked edges it belongs to: twice the largest distance from its centre.
// The diagonal of a box would depend on how the object is turned.
Vector chain_extent(const Positions& V, const Triangles& F, const EdgeMask& marked) {
  std::vector<int> parent(V.rows());
  std::iota(parent.begin(), parent.end(), 0);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (!marked(t, i)) continue;
      const int a = root(parent, F(t, (i + 1) % 3)), b = root(parent, F(t, (i + 2) % 3));
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  Positions centre = Positions::Zero(V.rows(), 3);
  Vector count = Vector::Zero(V.rows()), radius = Vector::Zero(V.rows());
  for (int v = 0; v < V.rows(); ++v) {
    centre.row(root(parent, v)) += V.row(v);
    count(root(parent, v)) += 1;
  }
  for (int v = 0; v < V.rows(); ++v) {
    const int r = root(parent, v);
    radius(r) = std::max(radius(r), (V.row(v) - centre.row(r) / count(r)).norm());
  }
  Vector extent(V.rows());
  for (int v = 0; v < V.rows(); ++v) extent(v) = 2 * radius(root(parent, v));
  return extent;
}

double region_extent(const Positions& V, const Triangles& F) {
  Vector3 centre = Vector3::Zero();
  for (int k = 0; k < F.size(); ++k) centre += V.row(F.data()[k]).transpose() / static_cast<double>(F.size());
  double radius = 0;
  for (int k = 0; k < F.size(); ++k) radius = std::max(radius, (V.row(F.data()[k]).transpose() - centre).norm());
  return 2 * radius;
}

}  // namespace

Positions triangle_normals(const Positions& V, const Triangles& F) {
  Positions normals(F.rows(), 3);
#pragma omp parallel for schedule(static) if (F.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(F.rows()); ++t) {
    const Vector3 a = V.row(F(t, 0)), b = V.row(F(t, 1)), c = V.row(F(t, 2));
    normals.row(t) = (b - a).cross(c - a).normalized();
  }
  return normals;
}

EdgeBends edge_bends(const Positions& normals, const Triangles& neighbors) {
  EdgeBends result(neighbors.rows(), 3);
#pragma omp parallel for schedule(static) if (neighbors.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(neighbors.rows()); ++t) {
    const Vector3 own = normals.row(t);
    for (int i = 0; i < 3; ++i) {
      const Vector3 other = normals.row(neighbors(t, i) < 0 ? t : neighbors(t, i));
      result(t, i) = std::atan2(own.cross(other).norm(), own.dot(other));
    }
  }
  return result;
}

EdgeMask crease_edges(const Positions& V, const Triangles& F, const Triangles& neighbors, double angle) {
  const EdgeBends bend = edge_bends(triangle_normals(V, F), neighbors);
  const double chained = std::min(angle, std::max(kChainShare * angle, kChainMedian * median_bend(bend, neighbors)));
  EdgeMask result = bend > chained;
  if (!result.any()) return result;
  const Vector extent = chain_extent(V, F, result);
  const double reach = kChainReach * region_extent(V, F);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      result(t, i) = result(t, i) && (bend(t, i) > angle || extent(F(t, (i + 1) % 3)) > reach);
    }
  }
  return result;
}

}  // namespace reflines
