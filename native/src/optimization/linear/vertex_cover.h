// A minimum vertex cover of a bipartite graph: the fewest vertices that touch every edge.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace reflines {

// An edge between a left and a right vertex, each numbered from 0.
using BipartiteEdge = std::pair<int, int>;

struct VertexCover {
  std::vector<char> left, right;  // for each vertex: 1 where it is in the cover
};

// The limit of edge visits, as a multiple of the number of edges: the cuts through surface meshes visit 2 to 10 times
// theirs.
constexpr std::size_t kCoverPatience = 200;

// Finds a cover with as many vertices as a maximum matching has edges (Koenig 1931). `edges` are sorted, and every left
// vertex has one. On a graph that takes longer than `patience` the matching is not completed: the result is a cover,
// but not a minimum one.
VertexCover minimum_vertex_cover(const std::vector<BipartiteEdge>& edges, int left_count, int right_count,
                                 std::size_t patience = kCoverPatience);

}  // namespace reflines
