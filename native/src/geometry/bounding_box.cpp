#include "geometry/bounding_box.h"

namespace reflines {

double bounding_box_diagonal(const Positions& V) { return (V.colwise().maxCoeff() - V.colwise().minCoeff()).norm(); }

Eigen::AlignedBox3d find_bounding_box(const Positions& V, const Triangles& F) {
  Eigen::AlignedBox3d result;
  for (const int v : F.reshaped()) result.extend(V.row(v).transpose());
  return result;
}

}  // namespace reflines
