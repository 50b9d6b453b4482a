// The centroids of triangles, in the image plane or in space.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns that of triangle t of F (#F x 3) as a row, for vertices P (#V x 2 or 3).
template <typename Places>
Eigen::Matrix<double, 1, Places::ColsAtCompileTime> find_centroid(const Places& P, const Triangles& F, Eigen::Index t) {
  return (P.row(F(t, 0)) + P.row(F(t, 1)) + P.row(F(t, 2))) / 3.0;
}

// Returns #F x 2 for vertices xy (#V x 2).
inline PlanePositions find_centroids(const PlanePositions& xy, const Triangles& F) {
  PlanePositions result(F.rows(), 2);
  for (Eigen::Index t = 0; t < F.rows(); ++t) result.row(t) = find_centroid(xy, F, t);
  return result;
}

}  // namespace reflines
