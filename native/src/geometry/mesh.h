// The connectivity of a triangle mesh, and the checks that it is a manifold surface of finite, non-degenerate
// triangles.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <numeric>
#include <vector>

#include "reflines/types.h"

namespace reflines {

// Lists of varying length in consecutive memory: the entries of list i are items[begin(i)] .. items[end(i) - 1].
struct Incidence {
  std::vector<int> offset;
  std::vector<int> items;

  int begin(int i) const { return offset[i]; }
  int end(int i) const { return offset[i + 1]; }
  int size() const { return static_cast<int>(offset.size()) - 1; }
};

// Builds lists of items: visit(take) calls take(list, item) for each, in the order that the lists keep, and does so
// twice.
template <typename Visit>
Incidence make_incidence(std::size_t lists, const Visit& visit) {
  Incidence result{std::vector<int>(lists + 1, 0), {}};
  visit([&](std::size_t list, int) { ++result.offset[list + 1]; });
  std::partial_sum(result.offset.begin(), result.offset.end(), result.offset.begin());
  result.items.resize(result.offset.back());
  std::vector<int> next(result.offset.begin(), result.offset.end() - 1);
  visit([&](std::size_t list, int item) { result.items[next[list]++] = item; });
  return result;
}

// Returns a normal of triangle t of V (#V x 3), F (#F x 3): as long as twice its area, or one of unit length, which is
// 0 for a triangle without area.
inline Vector3 area_normal(const Positions& V, const Triangles& F, int t) {
  const Vector3 a = V.row(F(t, 0)), b = V.row(F(t, 1)), c = V.row(F(t, 2));
  return (b - a).cross(c - a);
}
inline Vector3 unit_normal(const Positions& V, const Triangles& F, int t) { return area_normal(V, F, t).normalized(); }

// Returns the vertices of these triangles of F (#F x 3), ascending.
std::vector<int> list_vertices(const Triangles& F, const std::vector<int>& triangles);

// Throws InvalidInput where a triangle names a vertex that is not one of V (#V x 3).
void check_indices(const Positions& V, const Triangles& F);

// Throws InvalidInput where V (#V x 3) and F (#F x 3) cannot be a surface: no triangle at all, an index out of range,
// coordinates that are not finite, triangles without area in space, doubled triangles, an edge with more than two
// triangles.
void check_surface(const Positions& V, const Triangles& F);

// Returns the triangles (#F) for which check_surface would throw, but for their indices: not finite or without area, at
// an edge of three and more, doubled, or at a pole with too many; of those that meet so all count, for none is the
// right one.
Mask find_unusable(const Positions& V, const Triangles& F);

// Returns the triangle across the edge opposite each corner (#F x 3); -1 on the border, and at an edge of three
// triangles and more, where none is the one across.
Triangles edge_neighbors(const Triangles& F);

// Returns the numbers of triangles (#F x 3: those across their edges, or -1) in lists of those that edges join,
// ascending.
std::vector<std::vector<int>> find_components(const Triangles& neighbors);

// Returns the edges with one triangle, in the order of their triangles, as triangles without area: first, second,
// second.
Triangles find_border_edges(const Triangles& F, const Triangles& neighbors);

// Returns the vertices of edges with one triangle (#V).
Mask find_border_vertices(const Triangles& F, int vertex_count);

// Returns vertices that are marked (#V) as triangles without area, each at all of their corners.
Triangles list_points(const Mask& vertices);

// Returns the numbers of what is marked, ascending.
std::vector<int> list_marked(const Mask& marked);

// Returns for every vertex 0 .. vertex_count - 1 the triangles that touch it, ascending.
Incidence vertex_triangles(const Triangles& F, int vertex_count);

// Returns how many vertices of V (#V x 3) lie exactly on an earlier one, as in meshes whose faces were not joined.
int count_doubled_vertices(const Positions& V);

}  // namespace reflines
