#include "native/geometry/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "native/errors.h"

namespace reflines {
namespace {

// float32 positions round a collinear triangle to a height of about 1e-7 of its longest edge; thinner is no triangle.
constexpr double kFlatTriangle = 1e-7;

struct HalfEdge {
  int low, high;  // the two vertices, low < high
  int triangle, corner;
};

bool operator<(const HalfEdge& a, const HalfEdge& b) {
  if (a.low != b.low) return a.low < b.low;
  if (a.high != b.high) return a.high < b.high;
  return a.triangle < b.triangle;
}

bool same_edge(const HalfEdge& a, const HalfEdge& b) { return a.low == b.low && a.high == b.high; }

std::vector<HalfEdge> sorted_half_edges(const Triangles& F) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * F.rows());
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int a = F(t, (i + 1) % 3), b = F(t, (i + 2) % 3);
      edges.push_back({std::min(a, b), std::max(a, b), t, i});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::string count(int n, const std::string& one, const std::string& many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

void check_indices(const Positions& V, const Triangles& F) {
  if (F.rows() == 0) throw InvalidInput("The region has no face; select the faces of the panel first.");
  if (F.minCoeff() >= 0 && F.maxCoeff() < V.rows()) return;
  const int wrong = F.minCoeff() < 0 ? F.minCoeff() : F.maxCoeff();
  throw InvalidInput("The triangles name vertex " + std::to_string(wrong) + " but there are " +
                     std::to_string(V.rows()) + " vertices; pass indices from 0 to #V - 1.");
}

void check_finite(const Positions& V, const Triangles& F) {
  Mask bad = Mask::Constant(V.rows(), false);
  for (int k = 0; k < F.size(); ++k) bad(F.data()[k]) = !V.row(F.data()[k]).allFinite();
  const int many = static_cast<int>(bad.count());
  if (many == 0) return;
  throw InvalidInput(count(many, "vertex of the region has", "vertices of the region have") +
                     " a coordinate that is not a finite number; delete or retype " + (many == 1 ? "it." : "them."));
}

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

void check_doubled(const Triangles& F) {
  std::vector<std::array<int, 3>> keys(F.rows());
  for (int t = 0; t < F.rows(); ++t) {
    keys[t] = {F(t, 0), F(t, 1), F(t, 2)};
    std::sort(keys[t].begin(), keys[t].end());
  }
  std::sort(keys.begin(), keys.end());
  int doubled = 0;
  for (size_t k = 1; k < keys.size(); ++k) doubled += keys[k] == keys[k - 1];
  if (doubled == 0) return;
  throw InvalidInput(count(doubled, "face of the region is", "faces of the region are") +
                     " doubled (a second face on the same vertices); delete the copies, or deselect them.");
}

void check_manifold(const Triangles& F) {
  const std::vector<HalfEdge> edges = sorted_half_edges(F);
  int bad = 0;
  for (size_t k = 2; k < edges.size(); ++k) {
    const bool third = same_edge(edges[k], edges[k - 2]);
    const bool fourth = k >= 3 && same_edge(edges[k], edges[k - 3]);
    bad += third && !fourth;
  }
  if (bad == 0) return;
  throw InvalidInput(
      count(bad, "edge of the region has", "edges of the region have") +
      " more than two faces; find with Select > All by Trait > Non Manifold, then delete or deselect the extra "
      "faces.");
}

}  // namespace

void check_surface(const Positions& V, const Triangles& F) {
  check_indices(V, F);
  check_finite(V, F);
  check_area(V, F);
  check_doubled(F);
  check_manifold(F);
}

Triangles edge_neighbors(const Triangles& F) {
  Triangles neighbors = Triangles::Constant(F.rows(), 3, -1);
  const std::vector<HalfEdge> edges = sorted_half_edges(F);
  for (size_t k = 1; k < edges.size(); ++k) {
    if (!same_edge(edges[k], edges[k - 1])) continue;
    neighbors(edges[k].triangle, edges[k].corner) = edges[k - 1].triangle;
    neighbors(edges[k - 1].triangle, edges[k - 1].corner) = edges[k].triangle;
  }
  return neighbors;
}

Incidence vertex_triangles(const Triangles& F, int vertex_count) {
  Incidence result;
  result.offset.assign(vertex_count + 1, 0);
  for (int k = 0; k < F.size(); ++k) ++result.offset[F.data()[k] + 1];
  for (int v = 0; v < vertex_count; ++v) result.offset[v + 1] += result.offset[v];
  result.items.resize(F.size());
  std::vector<int> next(result.offset.begin(), result.offset.end() - 1);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) result.items[next[F(t, i)]++] = t;
  }
  return result;
}

Incidence vertex_neighbors(const Triangles& F, const Incidence& triangles_of_vertex) {
  Incidence result;
  result.offset.push_back(0);
  std::vector<int> around;
  for (int v = 0; v < triangles_of_vertex.size(); ++v) {
    around.clear();
    for (int k = triangles_of_vertex.begin(v); k < triangles_of_vertex.end(v); ++k) {
      for (int i = 0; i < 3; ++i) around.push_back(F(triangles_of_vertex.items[k], i));
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (int u : around) {
      if (u != v) result.items.push_back(u);
    }
    result.offset.push_back(static_cast<int>(result.items.size()));
  }
  return result;
}

std::vector<std::vector<int>> border_loops(const Triangles& F, const Triangles& neighbors) {
  std::multimap<int, int> next;  // a vertex where two loops touch has two successors
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) < 0) next.emplace(F(t, (i + 1) % 3), F(t, (i + 2) % 3));
    }
  }
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int> loop;
    for (auto edge = next.begin(); edge != next.end();) {
      const int to = edge->second;
      loop.push_back(edge->first);
      next.erase(edge);
      edge = next.find(to);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace reflines
