// Targets that set or turn the direction and the density of the lines (paper, section 4; Figures 9 and 11).
#pragma once

#include "reflines/region_field.h"
#include "reflines/target.h"

namespace reflines {

struct UniformOptions {
  Vector2 direction =
      Vector2::Zero();   // direction of the lines in the image plane, any length; zero: the region's median direction
  double density = 1.0;  // wanted |grad theta|: a factor of the region's median, or radians / length
  bool relative = true;  // selects the unit of `density`: true for the factor
  double density_end = -1.0;       // density at the far end of `axis`, in the same unit; negative: constant density
  Vector2 axis = Vector2::Zero();  // direction in the image plane along which the density varies linearly
};

// Builds the target of lines of one direction and density. `influence` (#F in [0, 1], or empty for 1) blends from the
// current field: 0 keeps it bit for bit, and it is multiplied by field.response. Of the two gradients across the
// direction, the one nearer to the region's median is taken.
Target build_uniform_target(const RegionField& field, const UniformOptions& options, const Vector& influence);

struct TurnOptions {
  double angle = 0;                // radians, counter-clockwise in the image plane
  double density = 1.0;            // a factor of each triangle's own |grad theta|
  double density_end = -1.0;       // the factor at the far end of `axis`; negative: constant
  Vector2 axis = Vector2::Zero();  // direction in the image plane along which the factor varies linearly
};

// Builds the target of the current gradients turned and scaled, both times the influence of each triangle and
// field.response: the lines keep their course where the angle is 0 and the density 1, bit for bit.
Target build_turned_target(const RegionField& field, const TurnOptions& options, const Vector& influence);

// Evaluates a fall-off curve c(d) for every triangle (#F) at its distance d from `centre` in the image plane: `curve`
// is tabulated at equal steps from d = 0 to d = radius, linear between, constant beyond. The result serves as a weight
// (paper: c >= 1) or as an influence in [0, 1].
Vector falloff(const RegionField& field, const Vector2& centre, double radius, const Vector& curve);

}  // namespace reflines
