#include "restoration/joined_mesh.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/nearest_surface.h"

namespace reflines {
namespace {

// Returns the border vertices as triangles without area, a vertex at each of their corners.
Triangles list_border_points(const Triangles& F, int vertex_count) {
  const Triangles neighbors = edge_neighbors(F);
  Mask on_border = Mask::Constant(vertex_count, false);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) >= 0) continue;
      on_border(F(t, (i + 1) % 3)) = on_border(F(t, (i + 2) % 3)) = true;
    }
  }
  Triangles points(on_border.count(), 3);
  Eigen::Index count = 0;
  for (int v = 0; v < vertex_count; ++v) {
    if (on_border(v)) points.row(count++).setConstant(v);
  }
  return points;
}

// Finds the vertices (#S) that lie within `reach` of some border vertex of the region.
Mask find_near(const Positions& vertices, const Positions& V, const Triangles& F, double reach) {
  Mask near = Mask::Constant(vertices.rows(), false);
  const Triangles points = list_border_points(F, static_cast<int>(V.rows()));
  std::vector<int> all(points.rows());
  std::iota(all.begin(), all.end(), 0);
  const NearestSurface border(V, points, std::move(all));
#pragma omp parallel for schedule(static) if (vertices.rows() > kWorthThreads)
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Vector3 p = vertices.row(v);
    const NearestPoint nearest = border.find(p, reach);
    near(v) = nearest.triangle >= 0 && (nearest.point - p).squaredNorm() < reach * reach;
  }
  return near;
}

// Returns the triangles of `around` that have a vertex marked as near (#S) or one of the region's.
Triangles take_near(const Surroundings& around, const Mask& near, int own) {
  std::vector<int> taken;
  const auto is_near = [&](int v) { return v < own || near(v - own); };
  for (int t = 0; t < around.F.rows(); ++t) {
    if (is_near(around.F(t, 0)) || is_near(around.F(t, 1)) || is_near(around.F(t, 2))) taken.push_back(t);
  }
  return around.F(taken, Eigen::all);
}

// Numbers the vertices beside the region in the order of the triangles, and leaves those out that are in none.
JoinedMesh renumber_beside(const Positions& all, const Triangles& F, int own) {
  std::vector<int> number(all.rows(), -1), kept(own);
  std::iota(kept.begin(), kept.end(), 0);
  std::copy(kept.begin(), kept.end(), number.begin());
  JoinedMesh joined{{}, F};
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    for (int& v : joined.F.row(t)) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(kept.size());
        kept.push_back(v);
      }
      v = number[v];
    }
  }
  joined.V = all(kept, Eigen::all);
  return joined;
}

}  // namespace

JoinedMesh join_surroundings(const Positions& V, const Triangles& F, const Surroundings& around, double reach) {
  const auto own = static_cast<int>(V.rows());
  Positions all(V.rows() + around.V.rows(), 3);
  all << V, around.V;
  const Triangles near = take_near(around, find_near(around.V, V, F, reach), own);
  Triangles joined(F.rows() + near.rows(), 3);
  joined << F, near;
  return renumber_beside(all, joined, own);
}

}  // namespace reflines
