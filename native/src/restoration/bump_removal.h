// Takes round dents and bumps out of a height field.
#pragma once

#include "geometry/height_field.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

struct BumpRemoval {
  Vector move;    // #V of the field, along the view, that takes the bumps away; of held vertices, too
  int count = 0;  // of the bumps
};

// Looks for bumps (see bump_search.h) up to the size of `length` in the Hessians of the heights, smoothed so far that
// the noise of the mesh does not hide them. `progress` may be null; throws Cancelled.
BumpRemoval remove_bumps(const HeightField& field, double length, Progress* progress);

}  // namespace reflines
