// A minimum vertex cover of a bipartite graph: the fewest vertices that touch every edge.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace reflines {

// A left and a right vertex, each numbered from 0.
using BipartiteEdge = std::pair<int, int>;

struct VertexCover {
  std::vector<char> left, right;  // for each vertex: whether it is in the cover
};

// Edges looked at, as a multiple of all: the cuts through surface meshes look at 2 to 10 times theirs.
constexpr std::size_t kCoverPatience = 200;

// As many vertices as a maximum matching has edges (Koenig 1931). `edges` are sorted, and every left vertex has one. On
// a graph that takes longer than `patience` the matching is not completed: what returns is a cover, not of the fewest.
VertexCover minimum_vertex_cover(const std::vector<BipartiteEdge>& edges, int left_count, int right_count,
                                 std::size_t patience = kCoverPatience);

}  // namespace reflines
