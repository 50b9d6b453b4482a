#include "geometry/mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "base/sort_unique.h"
#include "base/union_find.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

// The ratio of height to longest edge below which a triangle is degenerate: float32 positions give a collinear one
// about 1e-7.
constexpr double kFlatTriangle = 1e-7;

// The largest valence of a pole: stencils spread around it couple all of its spokes, and 4,000 take 7.5 s and 600 MB to
// factor, 2,000 a second.
constexpr int kMostSpokes = 2000;

struct HalfEdge {
  int low, high;  // the two vertices, low < high
  int triangle, corner;
};

// Compares half-edges of one lower vertex.
bool comes_first(const HalfEdge& a, const HalfEdge& b) {
  return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
}

bool same_edge(const HalfEdge& a, const HalfEdge& b) { return a.low == b.low && a.high == b.high; }

HalfEdge make_half_edge(const Triangles& F, int triangle, int corner) {
  const int a = F(triangle, (corner + 1) % 3), b = F(triangle, (corner + 2) % 3);
  return {std::min(a, b), std::max(a, b), triangle, corner};
}

// Sorts half-edges by lower vertex, then higher vertex, then triangle. They are distributed into one short list for
// each lower vertex first: linear in the size of the mesh, where one long sort took four times as long at a million
// vertices.
std::vector<HalfEdge> sort_half_edges(const Triangles& F) {
  const int count = static_cast<int>(F.size()), vertex_count = count > 0 ? F.maxCoeff() + 1 : 0;
  std::vector<int> start(vertex_count + 1, 0);
  for (int k = 0; k < count; ++k) ++start[make_half_edge(F, k / 3, k % 3).low + 1];
  for (int v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
  std::vector<HalfEdge> edges(count);
  std::vector<int> next(start.begin(), start.end() - 1);
  for (int k = 0; k < count; ++k) {
    const HalfEdge edge = make_half_edge(F, k / 3, k % 3);
    edges[next[edge.low]++] = edge;
  }
#pragma omp parallel for schedule(static) if (vertex_count > kWorthThreads)
  for (int v = 0; v < vertex_count; ++v) std::sort(edges.begin() + start[v], edges.begin() + start[v + 1], comes_first);
  return edges;
}

std::string count(int n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

void check_finite(const Positions& V, const Triangles& F) {
  Mask bad = Mask::Constant(V.rows(), false);
  for (int k = 0; k < F.size(); ++k) bad(F.data()[k]) = !V.row(F.data()[k]).allFinite();
  const int many = static_cast<int>(bad.count());
  if (many == 0) return;
  throw InvalidInput(count(many, "vertex of the region has", "vertices of the region have") +
                     " a coordinate that is not a finite number; delete or retype " + (many == 1 ? "it." : "them."));
}

// Returns whether a triangle has area; false where coordinates are not finite.
bool has_area(const Positions& V, const Triangles& F, int t) {
  const Vector3 a = V.row(F(t, 0)), b = V.row(F(t, 1)), c = V.row(F(t, 2));
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > kFlatTriangle * longest;
}

void check_area(const Positions& V, const Triangles& F) {
  int bad = 0;
  for (int t = 0; t < F.rows(); ++t) bad += !has_area(V, F, t);
  if (bad == 0) return;
  throw InvalidInput(count(bad, "face of the region has", "faces of the region have") +
                     " zero area; remove with Mesh > Clean Up > Degenerate Dissolve, or deselect.");
}

// Returns the number of triangles at each vertex.
IndexVector count_spokes(const Triangles& F) {
  IndexVector spokes = IndexVector::Zero(F.rows() > 0 ? F.maxCoeff() + 1 : 0);
  for (int k = 0; k < F.size(); ++k) ++spokes(F.data()[k]);
  return spokes;
}

void check_poles(const Triangles& F) {
  const IndexVector spokes = count_spokes(F);
  int worst = 0;
  if (spokes.maxCoeff(&worst) <= kMostSpokes) return;
  throw InvalidInput(std::to_string(spokes(worst)) + " triangles meet at vertex " + std::to_string(worst) +
                     " of the region, more than " + std::to_string(kMostSpokes) +
                     ": divide the large face or fan there, or leave it out of the region.");
}

// Throws where a triangle is doubled: its copy meets it across all three edges, with the same third vertex.
void check_doubled(const Triangles& F, const std::vector<HalfEdge>& edges) {
  const auto third = [&F](const HalfEdge& edge) { return F(edge.triangle, edge.corner); };
  int meetings = 0;
  for (size_t k = 1; k < edges.size(); ++k) {
    bool copy = false;
    for (size_t j = k; j-- > 0 && same_edge(edges[j], edges[k]);) copy = copy || third(edges[j]) == third(edges[k]);
    meetings += copy;
  }
  const int doubled = meetings / 3;
  if (doubled == 0) return;
  throw InvalidInput(count(doubled, "face of the region is", "faces of the region are") +
                     " doubled (a second face on the same vertices); delete the copies, or leave them out.");
}

void check_manifold(const std::vector<HalfEdge>& edges) {
  int bad = 0;
  for (size_t k = 2; k < edges.size(); ++k) {
    const bool third = same_edge(edges[k], edges[k - 2]);
    const bool fourth = k >= 3 && same_edge(edges[k], edges[k - 3]);
    bad += third && !fourth;
  }
  if (bad == 0) return;
  throw InvalidInput(count(bad, "edge of the region has", "edges of the region have") +
                     " more than two faces; delete the extra faces, or leave them out of the region.");
}

}  // namespace

void check_indices(const Positions& V, const Triangles& F) {
  if (F.size() == 0 || (F.minCoeff() >= 0 && F.maxCoeff() < V.rows())) return;
  const int wrong = F.minCoeff() < 0 ? F.minCoeff() : F.maxCoeff();
  throw InvalidInput("The triangles name vertex " + std::to_string(wrong) + " but there are " +
                     std::to_string(V.rows()) + " vertices; pass indices from 0 to #V - 1.");
}

void check_surface(const Positions& V, const Triangles& F) {
  if (F.rows() == 0) throw InvalidInput("The region has no face; choose the faces of the panel first.");
  check_indices(V, F);
  check_finite(V, F);
  check_area(V, F);
  check_poles(F);
  const std::vector<HalfEdge> edges = sort_half_edges(F);
  check_doubled(F, edges);
  check_manifold(edges);
}

Mask find_unusable(const Positions& V, const Triangles& F) {
  Mask unusable(F.rows());
  std::vector<int> solid;  // triangles with area: the others take no room at an edge
  for (int t = 0; t < F.rows(); ++t) {
    unusable(t) = !has_area(V, F, t);
    if (!unusable(t)) solid.push_back(t);
  }
  const Triangles own = F(solid, Eigen::all);
  const IndexVector spokes = count_spokes(own);
  for (const int t : solid) unusable(t) = spokes(F.row(t)).maxCoeff() > kMostSpokes;
  const std::vector<HalfEdge> edges = sort_half_edges(own);
  const auto third = [&own](const HalfEdge& edge) { return own(edge.triangle, edge.corner); };
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && same_edge(edges[begin], edges[end])) ++end;
    const bool doubled = end - begin == 2 && third(edges[begin]) == third(edges[begin + 1]);
    for (size_t k = begin; k < end && (doubled || end - begin > 2); ++k) unusable(solid[edges[k].triangle]) = true;
  }
  return unusable;
}

Triangles edge_neighbors(const Triangles& F) {
  Triangles neighbors = Triangles::Constant(F.rows(), 3, -1);
  const std::vector<HalfEdge> edges = sort_half_edges(F);
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && same_edge(edges[begin], edges[end])) ++end;
    if (end - begin != 2) continue;
    neighbors(edges[begin].triangle, edges[begin].corner) = edges[begin + 1].triangle;
    neighbors(edges[begin + 1].triangle, edges[begin + 1].corner) = edges[begin].triangle;
  }
  return neighbors;
}

std::vector<std::vector<int>> find_components(const Triangles& neighbors) {
  UnionFind joined(neighbors.rows());
  for (int t = 0; t < neighbors.rows(); ++t) {
    for (const int other : neighbors.row(t)) {
      if (other >= 0) joined.unite(t, other);
    }
  }
  return joined.list_sets();
}

Triangles find_border_edges(const Triangles& F, const Triangles& neighbors) {
  Triangles result((neighbors.array() < 0).count(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) < 0) result.row(count++) << F(t, (i + 1) % 3), F(t, (i + 2) % 3), F(t, (i + 2) % 3);
    }
  }
  return result;
}

Mask find_border_vertices(const Triangles& F, int vertex_count) {
  const Triangles edges = find_border_edges(F, edge_neighbors(F));
  Mask result = Mask::Constant(vertex_count, false);
  for (const int v : edges.reshaped()) result(v) = true;
  return result;
}

Triangles list_points(const Mask& vertices) {
  const std::vector<int> marked = list_marked(vertices);
  return Eigen::Map<const IndexVector>(marked.data(), static_cast<Eigen::Index>(marked.size())).replicate(1, 3);
}

std::vector<int> list_marked(const Mask& marked) {
  std::vector<int> result;
  for (int k = 0; k < marked.size(); ++k) {
    if (marked(k)) result.push_back(k);
  }
  return result;
}

Incidence vertex_triangles(const Triangles& F, int vertex_count) {
  return make_incidence(vertex_count, [&](const auto& take) {
    for (int k = 0; k < static_cast<int>(F.size()); ++k) take(F.data()[k], k / 3);
  });
}

std::vector<int> list_vertices(const Triangles& F, const std::vector<int>& triangles) {
  std::vector<int> result;
  for (const int t : triangles) result.insert(result.end(), {F(t, 0), F(t, 1), F(t, 2)});
  sort_unique(result);
  return result;
}

int count_doubled_vertices(const Positions& V) {
  std::vector<std::array<double, 3>> points(V.rows());
  for (Eigen::Index v = 0; v < V.rows(); ++v) points[v] = {V(v, 0), V(v, 1), V(v, 2)};
  std::sort(points.begin(), points.end());
  return static_cast<int>(points.end() - std::unique(points.begin(), points.end()));
}

}  // namespace reflines
