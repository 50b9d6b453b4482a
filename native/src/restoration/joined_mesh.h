// A region joined with the faces beside it, so that both can be solved for at once.
#pragma once

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

// The region, whose vertices and triangles come first, and triangles beside it. No vertex is in none of them.
struct JoinedMesh {
  Positions V;
  Triangles F;
};

// Joins the region V (#V x 3), F (#F x 3) with those triangles around it that have a vertex within `reach` of its
// border.
JoinedMesh join_surroundings(const Positions& V, const Triangles& F, const Surroundings& around, double reach);

}  // namespace reflines
