// Tells how well an eye sees each triangle of a surface.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// Returns how well each of these triangles of V (#V x 3), F (#F x 3) is seen by an eye in a unit direction, 0 to 1: 0
// where any other triangle hides its middle, and where it is turned away or seen at a grazing angle.
Vector weigh_sight(const Positions& V, const Triangles& F, const std::vector<int>& triangles, const Vector3& eye);

}  // namespace reflines
