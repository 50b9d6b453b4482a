// The surface on one side of an edge: normal and curvature at its middle, from the vertices of that side alone.
#pragma once

#include "reflines/types.h"

namespace reflines {

// The connectivity of a surface that ends at its seams: neighbours (#F x 3) are -1 across them.
struct CutSurface {
  const Triangles& F;          // #F x 3
  const Triangles& neighbors;  // #F x 3
};

struct SideFit {
  Vector3 normal = Vector3::Zero();
  double curvature = 0;  // normal curvature across the edge, 1 / length, positive where the surface bends to the normal
};

// Fits a cubic to the vertices around triangle t that are reached without crossing a seam or turning by more than 60
// degrees, and evaluates it at the point of the surface below or above `at`. `along` is the direction of the edge.
SideFit fit_side(const Positions& V, const CutSurface& surface, int t, const Vector3& at, const Vector3& along);

}  // namespace reflines
