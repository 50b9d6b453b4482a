#include "geometry/mask_room.h"

#include <algorithm>
#include <string>
#include <vector>

#include "reflines/errors.h"

namespace reflines {
namespace {

using std::to_string;

// With E <= M edges and F faces round a vertex the last weight has the index 2 + 5 M + F and the last index E + F - 1.
// Both have room where F <= M. Elsewhere E, M < F, so that up to F = 16 the least that is reserved suffices.
constexpr int kReserved = 16;
constexpr const char* kRemedy = "delete the inner ones until at most two share an edge.";

CageEdge find_most_crowded(const std::vector<CageEdge>& edges) {
  return *std::max_element(edges.begin(), edges.end(),
                           [](const CageEdge& a, const CageEdge& b) { return a.faces < b.faces; });
}

int find_largest_face(const Cage& cage) {
  const Eigen::Index faces = cage.face_offsets.size() - 1;
  return (cage.face_offsets.tail(faces) - cage.face_offsets.head(faces)).maxCoeff();
}

}  // namespace

void check_mask_room(const Cage& cage) {
  const std::vector<CageEdge> edges = cage_edges(cage);
  IndexVector edges_at = IndexVector::Zero(cage.vertices), faces_at = edges_at;
  for (const CageEdge& edge : edges) ++edges_at[edge.first], ++edges_at[edge.second];
  for (const int vertex : cage.face_vertices) ++faces_at[vertex];
  // The first level keeps these numbers and puts a vertex with 2 + k edges and 2 k faces on an edge of k faces, and one
  // with as many edges as corners, and no more faces, into each face.
  const CageEdge crowded = find_most_crowded(edges);
  const int room = std::max({kReserved, edges_at.maxCoeff(), find_largest_face(cage), 2 + crowded.faces});
  if (2 * crowded.faces > room) {
    throw InvalidInput(to_string(crowded.faces) + " faces of the cage share the edge between the vertices " +
                       to_string(crowded.first) + " and " + to_string(crowded.second) +
                       ", too many to be subdivided: " + kRemedy);
  }
  for (int v = 0; v < cage.vertices; ++v) {
    if (faces_at[v] <= room) continue;
    throw InvalidInput(to_string(faces_at[v]) + " faces of the cage, but only " + to_string(edges_at[v]) +
                       " edges, meet at vertex " + to_string(v) + ", too many to be subdivided: " + kRemedy);
  }
}

}  // namespace reflines
