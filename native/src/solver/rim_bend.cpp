#include "solver/rim_bend.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/crease.h"

namespace reflines {
namespace {

using Edge = std::pair<int, int>;  // the lower vertex first

struct Side {
  Edge edge;
  int triangle;

  bool operator<(const Side& other) const { return edge < other.edge; }
};

// Returns the sides of triangles (#F x 3), those of an edge beside one another.
std::vector<Side> list_sides(const Triangles& F) {
  std::vector<Side> result;
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) result.push_back({std::minmax(F(t, i), F(t, (i + 1) % 3)), t});
  }
  std::sort(result.begin(), result.end());
  return result;
}

// Returns the pairs of triangles, one of each mesh, with a common edge.
std::vector<std::pair<int, int>> find_shared(const Triangles& F, const Triangles& others) {
  const std::vector<Side> beside = list_sides(others);
  std::vector<std::pair<int, int>> result;
  for (const Side& side : list_sides(F)) {
    const auto found = std::lower_bound(beside.begin(), beside.end(), side);
    if (found != beside.end() && found->edge == side.edge) result.emplace_back(side.triangle, found->triangle);
  }
  return result;
}

double angle_between(const Vector3& one, const Vector3& other) {
  return std::atan2(one.cross(other).norm(), one.dot(other));
}

Positions with_others(const Positions& V, const Positions& others) {
  Positions result(V.rows() + others.rows(), 3);
  result << V, others;
  return result;
}

}  // namespace

double measure_rim_bend(const Positions& before, const Positions& after, const Triangles& F,
                        const Surroundings& around) {
  if (!around.exist()) return 0.0;
  const Positions inner[2] = {triangle_normals(before, F), triangle_normals(after, F)};
  const Positions outer[2] = {triangle_normals(with_others(before, around.V), around.F),
                              triangle_normals(with_others(after, around.V), around.F)};
  double most = 0.0;
  for (const auto& [own, other] : find_shared(F, around.F)) {
    double angle[2];
    for (int k = 0; k < 2; ++k) angle[k] = angle_between(inner[k].row(own), outer[k].row(other));
    most = std::max(most, angle[1] - angle[0]);
  }
  return most;
}

}  // namespace reflines
