#include "restoration/joined_mesh.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/nearest_surface.h"

namespace reflines {
namespace {

struct NearVertices {
  Mask near;  // #S
  int compared = 0;
};

// Finds the vertices (#S) that lie within `margin` of some border vertex of the region.
NearVertices find_near(const Positions& vertices, const Positions& V, const Triangles& F, double margin) {
  Mask near = Mask::Constant(vertices.rows(), false);
  int compared = 0;
  const Triangles points = list_points(find_border_vertices(F, static_cast<int>(V.rows())));
  const NearestSurface border(V, points);
#pragma omp parallel for schedule(static) reduction(+ : compared) if (vertices.rows() > kWorthThreads)
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Vector3 p = vertices.row(v);
    const NearestPoint nearest = border.find(p, margin);
    near(v) = nearest.triangle >= 0 && (nearest.point - p).squaredNorm() < margin * margin;
    compared += nearest.compared;
  }
  return {near, compared};
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

// Returns the first `own` triangles and those of the others that are not marked (#F).
Triangles leave_out(const Triangles& F, Eigen::Index own, const Mask& marked) {
  Mask kept = !marked;
  kept.head(own).setConstant(true);
  return F(list_marked(kept), Eigen::all);
}

// Finds the triangles (#F) that no path over edges joins with one of the first `own`.
Mask find_apart(const Triangles& F, Eigen::Index own) {
  const Triangles neighbors = edge_neighbors(F);
  Mask apart = Mask::Constant(F.rows(), true);
  apart.head(own).setConstant(false);
  std::vector<int> open(own);
  std::iota(open.begin(), open.end(), 0);
  while (!open.empty()) {
    const int t = open.back();
    open.pop_back();
    for (const int next : neighbors.row(t)) {
      if (next < 0 || !apart(next)) continue;
      apart(next) = false;
      open.push_back(next);
    }
  }
  return apart;
}

// Numbers the vertices beside the region in the order of the triangles, and leaves those out that are in none.
JoinedMesh renumber_beside(const Positions& all, const Triangles& F, int own) {
  std::vector<int> number(all.rows(), -1), kept(own);
  std::iota(kept.begin(), kept.end(), 0);
  std::copy(kept.begin(), kept.end(), number.begin());
  JoinedMesh joined{.V = {}, .F = F};
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

JoinedMesh join_surroundings(const Positions& V, const Triangles& F, const Surroundings& around, double margin) {
  const auto own = static_cast<int>(V.rows());
  Positions all(V.rows() + around.V.rows(), 3);
  all << V, around.V;
  const NearVertices found = find_near(around.V, V, F, margin);
  const Triangles near = take_near(around, found.near, own);
  Triangles joined(F.rows() + near.rows(), 3);
  joined << F, near;
  joined = leave_out(joined, F.rows(), find_unusable(all, joined));
  joined = leave_out(joined, F.rows(), find_apart(joined, F.rows()));
  JoinedMesh result = renumber_beside(all, joined, own);
  result.compared = found.compared;
  return result;
}

}  // namespace reflines
