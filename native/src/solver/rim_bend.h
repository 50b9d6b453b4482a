// The rim of a region: how a move bends the edges between its triangles and those beside it.
#pragma once

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

// Returns by how much more the edges between F (#F x 3) and the triangles around bend with the vertices at `after` than
// at `before` (#V x 3 each): the largest growth of an angle, radians; 0 where none grows, or none is shared.
double measure_rim_bend(const Positions& before, const Positions& after, const Triangles& F,
                        const Surroundings& around);

}  // namespace reflines
