// The part of a surface in which a change can be seen in the lines, with what judging it needs.
#pragma once

#include "reflines/image_plane.h"
#include "reflines/types.h"

namespace reflines {

// Returns which triangles (#F) lie within 1.5 lengths, size of flaws, of those that turn visibly between the positions
// `before` and `after` (#V x 3) of F: elsewhere both have the same lines, and the same estimate of the shape without
// flaws. Where that is most of the surface it is all of it. Turns of a triangle by less than 0.03 degrees do not count:
// they change lines by less than what is reported.
Mask find_changed_region(const Positions& before, const Positions& after, const Triangles& F, const ImagePlane& frame,
                         double length);

}  // namespace reflines
