// The target of the lines as they are, which a solve for other lines keeps as far as these allow.
#pragma once

#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

// Weight of the lines that are kept beside those that are wanted. Of 0, 0.001, 0.003, 0.01 and 0.03, means of 24
// changes to two bonnets: crossed lines change by 0.93, 0.88, 0.84, 0.78 and 0.69 degrees, and 0.627, 0.627, 0.628,
// 0.630 and 0.637 of the wanted changes is left. With 0.01 the crossed lines of the sample hood_warp wobble by 1.3
// degrees instead of 2.3, and 11.8 % of its warp is left instead of 11.3; with 0.1 16 % are, and a fender that is
// untwisted moves by 71 instead of 29 mm to keep what nobody looks at.
inline constexpr double kKeptWeight = 0.01;

// Builds the target of a family's current gradient (#F x 2) with the weight kKeptWeight on every triangle.
Target build_kept_target(const PlaneVectors& gradient, int family);

}  // namespace reflines
