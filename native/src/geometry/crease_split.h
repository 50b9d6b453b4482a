// Splits the vertices of a surface along its creases, so that each side of one has normals of its own.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

struct SplitSurface {
  Triangles F;              // #F x 3: the same triangles, of split vertices
  std::vector<int> vertex;  // #S: original vertex of each split vertex; the first #V are themselves
};

// Splits each vertex (V is #V x 3) into one for every fan of its triangles that are connected over edges which bend by
// no more than `angle` (radians). Throws InvalidInput for indices out of range.
SplitSurface split_at_creases(const Positions& V, const Triangles& F, double angle);

}  // namespace reflines
