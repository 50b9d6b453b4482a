// The target of a solve: one wanted gradient (or value) of theta and one weight per triangle.
#pragma once

#include "reflines/types.h"

namespace reflines {

// The wanted field of one family. Rows follow all triangles of the region (#F); those outside the height-field pieces
// are not read. Every tool of the add-on is a builder of this struct; the energy knows no tools.
struct Target {
  PlaneVectors gradient;  // #F x 2: wanted grad theta in the image plane, radians / length (eq. 4)
  Vector weight;          // #F, >= 0; empty: 1 everywhere
  // The wanted theta (#F), radians. If not empty, values are fitted (eq. 3); `gradient` then only regularizes the
  // surface at the scale of the triangles, with a weight that vanishes with their area, and may be empty.
  Vector theta;
  int family = 0;  // index of the light lines' family in the optimizer
  // Fits only the part of the gradient that heights can attain (see ReachableTarget) instead of minimizing the distance
  // to all of it; values beside such a gradient hold the lines only as far as that lets them. Set by the tools that
  // create new lines, whose unreachable part would otherwise imprint the triangulation on the lines.
  bool reachable_only = false;
};

}  // namespace reflines
