// Values at a region's rim, handed on into the region.
#pragma once

#include <functional>

#include "reflines/types.h"

namespace reflines {

// Fades from 1 at the rim to 0 at `r` = 1 and beyond, without an edge.
double fade(double r);

// Returns for each of the points (#P x 2) the value at the nearest place of the rim, whose edges (first, second,
// second) name points with a value each (#P), times `course` of its distance from there; 0 beyond `width`.
Vector spread_from_rim(const PlanePositions& points, const Triangles& edges, const Vector& values, double width,
                       const std::function<double(double distance)>& course);

}  // namespace reflines
