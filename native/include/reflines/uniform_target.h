// Targets that set or turn the direction and the density of the lines (paper, section 4; Figures 9 and 11).
#pragma once

#include "reflines/region_field.h"
#include "reflines/target.h"

namespace reflines {

struct UniformOptions {
  Vector2 direction = Vector2::Zero();  // of the lines in the image plane, any length; zero: that of the region's mean
  double density = 1.0;                 // |grad theta| wanted: a factor of the region's mean, or radians / length
  bool relative = true;                 // which of the two `density` is
  double density_end = -1.0;       // at the far end of `axis`, in the unit of density; negative: the same everywhere
  Vector2 axis = Vector2::Zero();  // in the image plane: along it the density goes linearly from one to the other
};

// Lines of one direction and density. `influence` (#F in [0, 1], or empty for 1) blends from the current field: 0 keeps
// it bit for bit, and so do features (field.feature). Of the two gradients across the direction the one that agrees
// with the region's mean is taken.
Target build_uniform_target(const RegionField& field, const UniformOptions& options, const Vector& influence);

// The current gradients turned by `angle` (radians, counter-clockwise in the image plane) times the influence of each
// triangle; 0 for features.
Target build_turned_target(const RegionField& field, double angle, const Vector& influence);

// c(d) for every triangle (#F): `curve` tabulated at equal steps from d = 0 to d = radius, linear between, constant
// beyond. `centre` in the image plane. As a weight (paper: c >= 1) or as an influence in [0, 1], as the tool wants.
Vector falloff(const RegionField& field, const Vector2& centre, double radius, const Vector& curve);

}  // namespace reflines
