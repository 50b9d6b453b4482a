// Weights that tell changes of the lines that mend flaws from those that damage the design.
#pragma once

#include "reflines/types.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {

// Computes weights (#F), 1 for flaws down to 0 for design (Geman-McClure weights), of the change (#F x m) that
// smoothing up to `length` makes to the fields of the lines. `centers` (#F x 2) and `area` (#F, 0 where a triangle does
// not count) are those of the triangles in the image plane. A flaw is shallow, or it is everywhere: noise and ripples
// change the lines of the whole region alike, so that the median tells them, and features change them at few places and
// much more. The changes of noise cancel out over some edges, those of features do not.
Vector flaw_weight(const TriangleFields& change, const PlanePositions& centers, const Vector& area, double length);

}  // namespace reflines
