// The target of the lines as they are, which a solve for other lines keeps as far as these allow.
#pragma once

#include "reflines/region_field.h"
#include "reflines/target.h"

namespace reflines {

// Weight of the lines that are kept beside those that are wanted. One family of lines leaves half of the shape to
// chance: of 0, 0.01, 0.1 and 0.3, a density of 1.2 on a bonnet with a scoop changes the crossed lines by 0.96, 0.8,
// 0.46, 0.30 degrees and leaves 0.82, 0.82, 0.84, 0.86 of the wanted change; an image's waves on another one 0.68,
// 0.64, 0.46, 0.34 degrees and 0.21, 0.22, 0.26, 0.34.
inline constexpr double kKeptWeight = 0.1;

// Builds the target of the current field with the weight kKeptWeight on every triangle.
Target build_kept_target(const RegionField& field);

}  // namespace reflines
