// Takes round dents and bumps out of a height field.
#pragma once

#include <functional>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/progress.h"
#include "reflines/types.h"
#include "restoration/bump_search.h"
#include "restoration/curvature_variation.h"

namespace reflines {

struct BumpRemoval {
  Vector heights;  // #V: without the bumps
  int count;
};

// Takes bumps (see bump_search.h) up to the size of `length` out of heights z over a plane (#V), those of held
// vertices, too: out of all, then where these were, since of dents that overlap the second is seen when the first is
// gone. They are looked for in the Hessians of what `smooth` makes of heights (#V), so far that the noise of the mesh
// does not hide them. `progress` may be null; throws Cancelled.
BumpRemoval remove_bumps(const CurvatureVariation& variation, const MeanPlane& plane, const Vector& z, double length,
                         const std::function<Vector(const Vector&)>& smooth, Progress* progress);

}  // namespace reflines
