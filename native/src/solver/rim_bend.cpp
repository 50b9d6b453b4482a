#include "solver/rim_bend.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/crease.h"
#include "geometry/mesh.h"

namespace reflines {
namespace {

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
  Triangles joined(F.rows() + around.F.rows(), 3);
  joined << F, around.F;
  const Triangles neighbors = edge_neighbors(joined);
  const Positions normals[2] = {triangle_normals(with_others(before, around.V), joined),
                                triangle_normals(with_others(after, around.V), joined)};
  double most = 0.0;
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    for (const int other : neighbors.row(t)) {
      if (other < F.rows()) continue;
      double angle[2];
      for (int k = 0; k < 2; ++k) angle[k] = angle_between(normals[k].row(t), normals[k].row(other));
      most = std::max(most, angle[1] - angle[0]);
    }
  }
  return most;
}

}  // namespace reflines
