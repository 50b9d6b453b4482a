#include "inspection/seams.h"

#include "geometry/crease.h"
#include "geometry/mesh.h"
#include "geometry/nearest_surface.h"

namespace reflines {
namespace {

// Marks the creases within the region (#F x 3). The rule sees the region alone, as the solver does.
EdgeMask find_creases(const Positions& V, const Triangles& F, const std::vector<int>& own,
                      const CreaseOptions& options) {
  const Triangles region = F(own, Eigen::all);
  const EdgeMask marked = crease_edges(V, region, edge_neighbors(region), options);
  EdgeMask result = EdgeMask::Constant(F.rows(), 3, false);
  for (size_t k = 0; k < own.size(); ++k) result.row(own[k]) = marked.row(static_cast<int>(k));
  return result;
}

// Finds the sheet that lies beside an edge where the region's own ends.
int find_beside(const Positions& V, const NearestSurface& outside, const Seam& seam, double distance) {
  const Vector3 a = V.row(seam.first), b = V.row(seam.second);
  return outside.find(0.5 * (a + b), distance * (b - a).norm()).triangle;
}

// Pairs the triangles across each edge (#F x 3). Within the region only its own count: what is fixed to it from beside
// makes no border there.
Triangles pair_triangles(const Triangles& F, const std::vector<int>& own) {
  Triangles result = edge_neighbors(F);
  const Triangles within = edge_neighbors(F(own, Eigen::all));
  for (size_t k = 0; k < own.size(); ++k) {
    for (int i = 0; i < 3; ++i) {
      const int other = within(static_cast<int>(k), i);
      if (other >= 0) result(own[k], i) = own[other];
    }
  }
  return result;
}

// Returns true where several triangles from outside meet the region's at an edge: none of them is its neighbour.
bool is_crowded(const Triangles& F, const Incidence& triangles_of_vertex, const Seam& seam) {
  int count = 0;
  for (int k = triangles_of_vertex.begin(seam.first); k < triangles_of_vertex.end(seam.first); ++k) {
    count += (F.row(triangles_of_vertex.items[k]).array() == seam.second).any();
  }
  return count > 2;
}

}  // namespace

Seams find_seams(const Positions& before, const Triangles& F, const Mask& region, const CheckOptions& options) {
  const std::vector<int> own = list_marked(region);
  const NearestSurface outside(before, F, list_marked(!region));
  const EdgeMask creases = find_creases(before, F, own, options.creases);
  const Incidence triangles_of_vertex = vertex_triangles(F, static_cast<int>(before.rows()));
  Seams seams{{}, pair_triangles(F, own)};
  const Triangles neighbors = seams.neighbors;
  for (const int t : own) {
    for (int i = 0; i < 3; ++i) {
      const int other = neighbors(t, i);
      Seam seam{F(t, (i + 1) % 3), F(t, (i + 2) % 3), t, other, SeamKind::kBorder, other >= 0};
      if (other < 0) {
        if (!is_crowded(F, triangles_of_vertex, seam))
          seam.other = find_beside(before, outside, seam, options.neighbor_distance);
        if (seam.other < 0) seam.kind = SeamKind::kOpen;
      } else if (region(other)) {
        if (!creases(t, i)) continue;
        seam.kind = SeamKind::kCrease;
      }
      seams.neighbors(t, i) = -1;
      if (seam.kind == SeamKind::kCrease && other < t) continue;  // reported from the first of its triangles
      for (int j = 0; seam.kind == SeamKind::kBorder && other >= 0 && j < 3; ++j) {
        if (neighbors(other, j) == t) seams.neighbors(other, j) = -1;
      }
      seams.list.push_back(seam);
    }
  }
  return seams;
}

}  // namespace reflines
