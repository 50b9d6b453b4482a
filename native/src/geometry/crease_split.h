// Splits the vertices of a surface along its creases, so that each side of one has normals of its own.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

struct SplitSurface {
  Triangles F;              // #F x 3: the same triangles, of split vertices
  std::vector<int> vertex;  // #S: the vertex that each split vertex was; the first #V are themselves
};

// Each vertex once for every fan of its triangles that hangs together over edges which bend by no more than `angle`
// (radians). V is #V x 3. Throws InvalidInput for indices out of range.
SplitSurface split_at_creases(const Positions& V, const Triangles& F, double angle);

}  // namespace reflines
