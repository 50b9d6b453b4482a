// Finds the pairs of vertices that lie in each other's mirror image.
#pragma once

#include "reflines/types.h"

namespace reflines {

struct MirrorPlane {
  Vector3 point;
  Vector3 normal;  // any length
};

// Returns for each vertex (#V) the vertex at its mirror image within `tolerance` (a length): itself on the plane, -1
// where there is none. Partners are mutual. Of coincident vertices the first are paired with the first. Throws
// InvalidInput: a normal of length 0, a plane that is not finite, a tolerance that is negative or not a number.
IndexVector mirror_pairs(const Positions& V, const MirrorPlane& plane, double tolerance);

}  // namespace reflines
