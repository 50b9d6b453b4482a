// How far a change of the lines is the mending of a flaw, and not damage to the design.
#pragma once

#include "reflines/types.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {

// #F, 1 for flaws down to 0 for design (Geman-McClure weights), of the change (#F x m) that smoothing up to `length`
// makes to the fields of the lines. `centers` (#F x 2) and `area` (#F, 0 where a triangle does not count) are those of
// the triangles in the image plane. A flaw is shallow, or it is everywhere: noise and ripples change the lines of the
// whole region alike, so that the median tells them, and features change them at few places and much more.
Vector flaw_weight(const TriangleFields& change, const PlanePositions& centers, const Vector& area, double length);

// The median of `values` (#), each counted as often as `weight` (#, >= 0) says.
double weighted_median(const Vector& values, const Vector& weight);

}  // namespace reflines
