// Finds the vertices of a cage that must be held so that the border of the subdivided surface stays. Borders are those
// of the refined surface; the subdivision matrices tell on which vertices of the cage it depends.
#pragma once

#include <vector>

#include "reflines/border.h"
#include "reflines/subdivision.h"
#include "reflines/types.h"

namespace reflines {

// Returns the refined vertices (#refined) on edges of exactly one refined face of the region. `region` (#cage faces)
// are the cage's faces that may change; where they end inside the surface, there is a border too.
Mask find_refined_border(const Subdivision& subdivision, const Mask& region);

// Returns the condition of each refined vertex (#refined): on the region's border that of the cage's border vertex with
// the largest weight, of equal ones the firmest; elsewhere kFree. `border` (#V) is read at the cage's border vertices.
std::vector<Border> refine_border(const Subdivision& subdivision, const Mask& region,
                                  const std::vector<Border>& border);

// Returns the cage vertices to hold (#V), including those of no region face. They follow from the matrices, with these
// results:
// * where the region ends at the surface's own border, positions depend on that border's ring of the cage, and tangents
// on one ring more: the vertices of its faces. Extraordinary vertices, n-gons and creases change nothing.
// * where the region ends inside the surface, both depend on its border's ring and one ring more. All refined vertices
// outside stay then, too, and with them the curvature across the border where the surface is regular.
// The set is minimal: on a sheet, positions and tangents of the border determine every held vertex.
// `border` (#V) is read at the cage's vertices on the border. A point of the surface's border has the condition of the
// one that weighs most there: where a held segment meets a free one, it is held up to the middle of the edge between.
Mask find_held_vertices(const Subdivision& subdivision, const Mask& region, const std::vector<Border>& border);

}  // namespace reflines
