// Cages that are symmetric about a plane, and the unknowns that keep them so.
#pragma once

#include "native/types.h"

namespace reflines {

struct MirrorPlane {
  Vector3 point;
  Vector3 normal;  // any length
};

// #V: the vertex where a vertex's mirror image lies, within `tolerance` (a length): itself on the plane, -1 where there
// is none. Partners are mutual. Of vertices in one place the first are paired with the first. Throws InvalidInput: a
// normal of length 0.
IndexVector mirror_pairs(const Positions& V, const MirrorPlane& plane, double tolerance);

// B, #V x n, of z = B x + c for heights of a cage: one unknown a pair of partners and one for each other vertex, in the
// order of their first vertices; none where the vertex or its partner is held. `partner` may be empty: no symmetry.
// Heights of partners rise alike, which keeps a cage symmetric where the view direction lies in the plane.
SparseMatrix cage_unknowns(const Mask& held, const IndexVector& partner);

}  // namespace reflines
