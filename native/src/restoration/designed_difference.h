// Tells what the halves of a panel differ by on purpose (a handle, a badge, a scoop on one side) from flaws.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Finds the vertices (#V) where a difference of heights (#V), of the surface and its mirror image, is design: connected
// regions of one sign around places that are steeper than flaws are, or higher than `deepest`. xy (#V x 2), triangles
// F; `roughness` (#V, >= 0) is how far the difference is from smooth around each vertex, in units of height, `length`
// the size of flaws. A region is the whole of a difference, with its skirts: were the steep parts alone kept, a design
// would become another one.
Mask find_designed_differences(const PlanePositions& xy, const Triangles& F, const Vector& difference,
                               const Vector& roughness, double deepest, double length);

}  // namespace reflines
