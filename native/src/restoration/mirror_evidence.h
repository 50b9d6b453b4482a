// A panel that is symmetric but for its flaws tells them from design: what one half has and the other has not is a
// flaw, and it is taken from the half that is the rougher for it; unless it is as steep as no flaw is (see
// designed_difference.h).
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"
#include "restoration/mirror_images.h"

namespace reflines {

struct MirrorEvidence {
  Vector correction;  // #V: heights along the view to add so that halves are alike; 0 where they are, or by design
  std::vector<MirrorImages> images;  // across all planes of symmetry, before the correction; none: no symmetry
};

// Returns the vertices of a height field as the view sees them.
SeenPoints see_vertices(const HeightField& field, double diagonal);

// Finds the evidence of a region at heights z along the view (#V). Images are those of its vertices where they are at
// the start: what a dent moved aside stays there. `length` is the size of flaws, over which the halves' roughness is
// compared, and `axes` (#A x 3) are those of the object, in the field's coordinates.
MirrorEvidence find_mirror_evidence(const HeightField& field, const Vector& z, double diagonal, double length,
                                    const Positions& axes);

}  // namespace reflines
