// A panel that is symmetric but for its flaws tells them from design: what one half has and the other has not is a
// flaw, and it is taken from the half that is the rougher for it; unless it is as steep as no flaw is (see
// designed_difference.h).
#pragma once

#include "reflines/types.h"

namespace reflines {

struct MirrorEvidence {
  IndexVector
      partner;  // #V: the vertex in each vertex's place on the other side, itself on the plane; empty: no symmetry
  Vector correction;  // #V: heights to add so that partners are equally high; 0 where they are
  Mask design;        // #V: where they differ by design; their own partners there
};

// Finds the partners of vertices xy (#V x 2), z (#V), each itself where it has none; empty where the vertices are not
// symmetric. Planes through the view direction are tried: across the principal axes of the vertices and across `axes`
// (#A x 2, those of the object). Vertices count as symmetric where 97 % of them have a partner in the image plane
// within 1e-4 of the diagonal and as high within 3e-3 of it: deeper differences are design.
IndexVector find_mirror_partners(const PlanePositions& xy, const Vector& z, double diagonal,
                                 const PlanePositions& axes);

// Finds the evidence of a region with triangles F; `length` is the size of flaws, over which the halves' roughness is
// compared.
MirrorEvidence find_mirror_evidence(const PlanePositions& xy, const Vector& z, const Triangles& F, double diagonal,
                                    double length, const PlanePositions& axes);

}  // namespace reflines
