// The centroids of triangles in the image plane.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns #F x 2 for vertices xy (#V x 2).
inline PlanePositions find_centroids(const PlanePositions& xy, const Triangles& F) {
  PlanePositions result(F.rows(), 2);
  for (Eigen::Index t = 0; t < F.rows(); ++t)
    result.row(t) = (xy.row(F(t, 0)) + xy.row(F(t, 1)) + xy.row(F(t, 2))) / 3.0;
  return result;
}

}  // namespace reflines
