// The surface around a region, which gives the curvature that a border is to have.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Triangles beside the region, three rings or more. F names the region's vertices by their numbers 0 .. n - 1, and
// those of V, which are not the region's, by n and more.
struct Surroundings {
  Positions V;  // #S x 3
  Triangles F;  // #G x 3

  bool exist() const { return F.rows() > 0; }
};

}  // namespace reflines
