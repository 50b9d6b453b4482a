// A panel that is symmetric but for its flaws tells them from design: what one half has and the other has not is a
// flaw, and it is taken from the half that is the rougher for it; unless it is as steep as no flaw is (see
// designed_difference.h).
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// The images of vertices across one plane of symmetry.
struct MirrorPartners {
  IndexVector partner;  // #V: the vertex in each one's place on the other side, itself where there is none
  double weight;        // 0 to 1: how surely the panel is symmetric about the plane
};

struct MirrorEvidence {
  int vertices = 0;                      // those of a symmetric panel; 0: no symmetry
  Vector correction;                     // #V: heights to add so that partners are equally high; 0 where they are
  Mask design;                           // #V: where they differ by design
  std::vector<MirrorPartners> partners;  // see find_mirror_partners
};

// Finds the partners of vertices xy (#V x 2), z (#V) across all planes of symmetry; none where differences are deeper
// than flaws are. Planes through the view direction are tried: those that the moments of the vertices allow, which are
// the principal axes and those of a square and a triangle, and those across `axes` (#A x 2, those of the object).
// Vertices count as symmetric about a plane where 98 % of them have a partner in the image plane within 1e-4 of the
// diagonal and as high within 3e-3 of it, and less and less down to 95 %.
std::vector<MirrorPartners> find_mirror_partners(const PlanePositions& xy, const Vector& z, double diagonal,
                                                 const PlanePositions& axes);

// Finds the evidence of a region with triangles F; `length` is the size of flaws, over which the halves' roughness is
// compared.
MirrorEvidence find_mirror_evidence(const PlanePositions& xy, const Vector& z, const Triangles& F, double diagonal,
                                    double length, const PlanePositions& axes);

}  // namespace reflines
