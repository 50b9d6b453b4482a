// The target of the lines as they are, which a solve for other lines keeps as far as these allow.
#pragma once

#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

// Weight of the lines that are kept beside those that are wanted: with ten times as much a fender that is untwisted
// moves by 71 instead of 29 mm to keep what nobody looks at.
inline constexpr double kKeptWeight = 0.01;

// Builds the target of a family's current gradient (#F x 2) with the weight kKeptWeight on every triangle.
Target build_kept_target(const PlaneVectors& gradient, int family);

}  // namespace reflines
