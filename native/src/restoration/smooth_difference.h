// Tells what the halves of a panel differ by smoothly, over more than the size of flaws, which is design.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the smooth part (#V) of differences of heights (#V) at the places q (#V x 2): at each the value of a
// quadratic by least squares, of the differences that count (#V) within two lengths; none where it explains no more
// than 0.7 of their squares around, all of it from 0.95 on. Dents and ripples are explained by less than half, at a
// corner, too, where a quadratic follows a ripple; designs that are turned or bowed on one side by nearly all.
// Differences below `least` are none.
Vector find_smooth_difference(const PlanePositions& q, const Vector& difference, const Mask& counts, double length,
                              double least);

}  // namespace reflines
