#include "geometry/open_border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "geometry/mesh.h"

namespace reflines {
namespace {

constexpr double kTurned = 0.5;  // cosine of 60 degrees

using EdgeNormals = std::map<std::pair<int, int>, std::vector<Vector3>>;

// Returns the unit normals of the triangles around, by the edges of the region that they may have, too.
EdgeNormals list_around(const Positions& V, const Surroundings& around) {
  Positions all(V.rows() + around.V.rows(), 3);
  all << V, around.V;
  EdgeNormals result;
  for (int t = 0; t < around.F.rows(); ++t) {
    const Vector3 n = unit_normal(all, around.F, t);
    for (int i = 0; i < 3; ++i) {
      const std::pair<int, int> ends = std::minmax(around.F(t, (i + 1) % 3), around.F(t, (i + 2) % 3));
      if (ends.second < V.rows()) result[ends].push_back(n);
    }
  }
  return result;
}

bool runs_on(const EdgeNormals& around, int first, int second, const Vector3& normal) {
  const auto found = around.find(std::minmax(first, second));
  return found != around.end() && std::any_of(found->second.begin(), found->second.end(),
                                              [&](const Vector3& other) { return other.dot(normal) > kTurned; });
}

void normalize_rows(Positions& vectors) {
  for (Eigen::Index k = 0; k < vectors.rows(); ++k) {
    const double norm = vectors.row(k).norm();
    if (norm > 0) vectors.row(k) /= norm;
  }
}

}  // namespace

OpenBorder find_open_border(const Positions& V, const Triangles& F, const Surroundings& around) {
  OpenBorder border;
  border.vertices = border.elsewhere = Mask::Constant(V.rows(), false);
  border.normal = border.outward = Positions::Zero(V.rows(), 3);
  const EdgeNormals beside = list_around(V, around);
  const Triangles neighbors = edge_neighbors(F);
  for (int t = 0; t < F.rows(); ++t) {
    const Vector3 n = area_normal(V, F, t);
    for (int i = 0; i < 3; ++i) {
      border.normal.row(F(t, i)) += n;
      if (neighbors(t, i) >= 0) continue;
      const int a = F(t, (i + 1) % 3), b = F(t, (i + 2) % 3);
      const bool open = !runs_on(beside, a, b, n.normalized());
      Mask& kind = open ? border.vertices : border.elsewhere;
      kind(a) = kind(b) = true;
      if (!open) continue;
      const Vector3 along = V.row(b) - V.row(a), across = along.cross(n.normalized());
      border.outward.row(a) += across.normalized();
      border.outward.row(b) += across.normalized();
      border.edges.push_back({a, b, t});
      border.edge += along.norm();
    }
  }
  border.edge /= std::max<double>(1, static_cast<double>(border.edges.size()));
  normalize_rows(border.normal);
  for (Eigen::Index v = 0; v < V.rows(); ++v)
    border.outward.row(v) -= border.outward.row(v).dot(border.normal.row(v)) * border.normal.row(v);
  normalize_rows(border.outward);
  return border;
}

}  // namespace reflines
