// The target of a solve: one wanted gradient (or value) of theta and one weight per triangle.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Rows follow the triangles of the region that was handed in (#F), also those that are no part of a height-field piece:
// there they are not read. Every tool of the add-on is a builder of this one struct; the energy knows no tools.
struct Target {
  PlaneVectors gradient;  // #F x 2: wanted grad theta in the image plane, radians / length (eq. 4)
  Vector weight;          // #F, >= 0; empty: 1 everywhere
  // #F: wanted theta, radians. If not empty, values are fitted (eq. 3); `gradient` then only keeps the surface smooth
  // at the scale of the triangles, with a weight that vanishes with their area, and may be empty.
  Vector theta;
  int family = 0;  // which of the optimizer's families of light lines
  // Asks for the part of the gradient that heights can reach (see ReachableTarget), not for the nearest to all of it.
  // Tools that invent lines set it: what of them is beyond reach would print the mesh into the field.
  bool reachable_only = false;
};

}  // namespace reflines
