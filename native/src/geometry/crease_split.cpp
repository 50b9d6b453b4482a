#include "geometry/crease_split.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "base/union_find.h"
#include "geometry/crease.h"
#include "geometry/mesh.h"

namespace reflines {
namespace {

// The ratio of height to longest edge below which the normal of a triangle with rounded positions is noise (a vertex on
// the straight side of an n-gon leaves such a triangle).
constexpr double kThin = 1e-3;

// Returns the corner opposite the longest edge of a thin triangle; -1 for others.
int blunt_corner(const Positions& V, const Triangles& F, int t) {
  const Vector3 p[3] = {V.row(F(t, 0)), V.row(F(t, 1)), V.row(F(t, 2))};
  int corner = 0;
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const double length = (p[(i + 1) % 3] - p[(i + 2) % 3]).norm();
    if (length > longest) corner = i;
    longest = std::max(longest, length);
  }
  return (p[1] - p[0]).cross(p[2] - p[0]).norm() < kThin * longest * longest ? corner : -1;
}

// Returns the normals, where a thin triangle has that of its neighbour across the longest edge and so bends no edge
// itself.
Positions compute_trusted_normals(const Positions& V, const Triangles& F, const Triangles& neighbors) {
  const Positions own = triangle_normals(V, F);
  Positions normals = own;
  for (int t = 0; t < static_cast<int>(F.rows()); ++t) {
    const int corner = blunt_corner(V, F, t);
    if (corner >= 0 && neighbors(t, corner) >= 0) normals.row(t) = own.row(neighbors(t, corner));
  }
  return normals;
}

// The fans of triangles around vertices as disjoint sets of corners; corner i of triangle t is 3 t + i.
class Fans {
 public:
  explicit Fans(const Triangles& F) : F_(F), corners_(F.size()) {}

  void join_across(int t, int edge, int other) {
    for (const int corner : {(edge + 1) % 3, (edge + 2) % 3}) {
      for (int i = 0; i < 3; ++i) {
        if (F_(other, i) == F_(t, corner)) corners_.unite(3 * t + corner, 3 * other + i);
      }
    }
  }

  int representative(int corner) { return corners_.find(corner); }

 private:
  const Triangles& F_;
  UnionFind corners_;
};

Fans fans_between_creases(const Positions& V, const Triangles& F, double angle) {
  const Triangles neighbors = edge_neighbors(F);
  const EdgeBends bend = edge_bends(compute_trusted_normals(V, F, neighbors), neighbors);
  Fans fans(F);
  for (int t = 0; t < static_cast<int>(F.rows()); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) > t && !(bend(t, i) > angle)) fans.join_across(t, i, neighbors(t, i));
    }
  }
  return fans;
}

}  // namespace

SplitSurface split_at_creases(const Positions& V, const Triangles& F, double angle) {
  check_indices(V, F);
  Fans fans = fans_between_creases(V, F, angle);
  SplitSurface split{F, std::vector<int>(V.rows())};
  std::iota(split.vertex.begin(), split.vertex.end(), 0);
  std::vector<bool> taken(V.rows(), false);
  for (int corner = 0; corner < static_cast<int>(F.size()); ++corner) {
    const int first = fans.representative(corner), v = F.data()[corner];
    if (first < corner) {
      split.F.data()[corner] = split.F.data()[first];
    } else if (taken[v]) {
      split.F.data()[corner] = static_cast<int>(split.vertex.size());
      split.vertex.push_back(v);
    }
    taken[v] = true;
  }
  return split;
}

}  // namespace reflines
