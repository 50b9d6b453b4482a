// A region joined with the faces beside it, so that both can be solved for at once.
#pragma once

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

// The region, whose vertices and triangles come first, and triangles beside it. No vertex is in none of them.
struct JoinedMesh {
  Positions V;
  Triangles F;
  int compared = 0;  // pairs of a vertex beside the region and a border vertex whose distance was computed
};

// Joins the region V (#V x 3), F (#F x 3) with those triangles around it that
//  1. have a vertex within `margin` of its border,
//  2. can be part of a surface, with the region and with each other (find_unusable in geometry/mesh.h): they advise on
//     the region, and a mesh that is untidy beside it is no reason to refuse it,
//  3. are connected with the region over edges of such triangles: others say nothing about it.
JoinedMesh join_surroundings(const Positions& V, const Triangles& F, const Surroundings& around, double margin);

}  // namespace reflines
