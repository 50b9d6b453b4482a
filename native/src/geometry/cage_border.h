// Finds the vertices of a cage that must stay so that the border of the subdivided surface stays. Borders are those of
// the refined surface, and the subdivision matrices say which vertices of the cage it depends on.
#pragma once

#include "reflines/border.h"
#include "reflines/subdivision.h"
#include "reflines/types.h"

namespace reflines {

// #refined: the vertices on edges of exactly one refined face of the region. `region` (#cage faces) are the cage's
// faces that may change; where they end inside the surface, that is a border like the surface's own.
Mask refined_border(const Subdivision& subdivision, const Mask& region);

// #V: the cage vertices to hold, those of no region face among them. Worked out from the matrices, and always this:
// * where the region ends at the surface's own border, positions need that border's ring of the cage, and tangents
//   one ring more: the vertices that share a face with it. Extraordinary vertices, n-gons and creases change nothing.
// * where the region ends inside the surface, both need its border's ring and one ring more. All refined vertices
//   outside stay then, too, and with them the curvature across the border where the surface is regular.
// None is held without need: on a sheet, positions and tangents of the border determine every held vertex.
Mask held_by_border(const Subdivision& subdivision, const Mask& region, Border hold);

}  // namespace reflines
