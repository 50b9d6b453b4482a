// The checks of what the measures of a panel are given.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput: other sizes, indices out of range, a region that is no surface, coordinates of its neighbours
// that are not finite.
void check_compared(const Positions& before, const Positions& after, const Triangles& F, const Mask& region);

// Throws InvalidInput where a pass mark is negative or not finite.
void check_mark(double mark, const char* name);

}  // namespace reflines
