// Finds pairs of pulled places that force lines to cross.
#pragma once

#include "geometry/triangle_locator.h"
#include "reflines/region_field.h"
#include "reflines/types.h"

namespace reflines {

// A place of a handle.
struct HandlePlace {
  Location at;
  Vector2 point = Vector2::Zero();
  double theta = 0.0;   // of its line now
  double change = 0.0;  // the wanted change of theta
};

// Returns whether the lines through two places cannot run without a crossing: their order across the lines is to be
// reversed, or they are much closer than lines of such different values can be.
bool force_crossing(const RegionField& field, const HandlePlace& one, const HandlePlace& other);

}  // namespace reflines
