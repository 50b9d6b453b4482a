// A panel that is symmetric but for its flaws tells them from design: what one half has and the other has not is a
// flaw, and it is taken from the half that is the rougher for it.
#pragma once

#include "reflines/types.h"

namespace reflines {

struct MirrorEvidence {
  IndexVector
      partner;  // #V: the vertex in each vertex's place on the other side, itself on the plane; empty: no symmetry
  Vector correction;  // #V: heights to add so that partners are equally high; 0 where they are
};

// xy (#V x 2), z (#V), F of a region in the image plane; `diagonal` its size, `length` that of the flaws. Planes
// through the view direction are tried: across the principal axes of the vertices and across `axes` (#A x 2, those of
// the object). A region counts as symmetric where 97 % of its vertices have a partner in the image plane within 1e-4 of
// the diagonal and as high within 3e-3 of it: deeper differences are design.
MirrorEvidence find_mirror_evidence(const PlanePositions& xy, const Vector& z, const Triangles& F, double diagonal,
                                    double length, const PlanePositions& axes);

}  // namespace reflines
