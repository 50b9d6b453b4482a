#include "inspection/side_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/sort_unique.h"
#include "geometry/height_fit.h"
#include "geometry/mesh.h"

namespace reflines {
namespace {

// The number of vertices from which a fit that is determined grows no further; a cubic has ten coefficients.
constexpr size_t kEnoughVertices = 16;
constexpr int kMostLayers = 8;   // of triangles around the first, where a side has few vertices
constexpr double kTurned = 0.5;  // cosine of 60 degrees

// Adds the triangles across the edges of those there are, where they face the same way.
void grow(const Positions& V, const CutSurface& surface, const Vector3& normal, std::vector<int>& triangles) {
  for (size_t k = 0, n = triangles.size(); k < n; ++k) {
    for (int i = 0; i < 3; ++i) {
      const int other = surface.neighbors(triangles[k], i);
      if (other >= 0 && unit_normal(V, surface.F, other).dot(normal) > kTurned) triangles.push_back(other);
    }
  }
  sort_unique(triangles);
}

// The frame of a fit: its origin, the edge's direction, that across it, and the normal.
struct Frame {
  Vector3 at, e1, e2, n;
};

HeightFit fit_vertices(const Positions& V, const std::vector<int>& vertices, const Frame& frame) {
  PlanePositions points(static_cast<Eigen::Index>(vertices.size()), 2);
  Vector heights(points.rows());
  for (Eigen::Index k = 0; k < heights.size(); ++k) {
    const Vector3 d = V.row(vertices[k]).transpose() - frame.at;
    points.row(k) << d.dot(frame.e1), d.dot(frame.e2);
    heights(k) = d.dot(frame.n);
  }
  return fit_heights(points, heights);
}

}  // namespace

SideFit fit_side(const Positions& V, const CutSurface& surface, int t, const Vector3& at, const Vector3& along) {
  const Vector3 n = unit_normal(V, surface.F, t);
  const Vector3 e1 = (along - n * n.dot(along)).normalized();
  const Frame frame{at, e1, n.cross(e1), n};
  std::vector<int> triangles = {t};
  HeightFit best;
  for (int layer = 0; layer < kMostLayers && best.degree < 3; ++layer) {
    grow(V, surface, n, triangles);
    const std::vector<int> vertices = list_vertices(surface.F, triangles);
    if (vertices.size() < kEnoughVertices && layer + 1 < kMostLayers) continue;
    best = fit_vertices(V, vertices, frame);
  }
  const double steep = 1 + best.slope.y() * best.slope.y();  // squared length of the tangent across, over that of e2
  return {(n - best.slope.x() * e1 - best.slope.y() * frame.e2).normalized(),
          best.second.z() / (steep * std::sqrt(steep + best.slope.x() * best.slope.x()))};
}

}  // namespace reflines
