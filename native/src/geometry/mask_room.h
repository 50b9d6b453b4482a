// Checks that OpenSubdiv's limit evaluation has room for the masks of non-manifold vertices.
#pragma once

#include "reflines/cage.h"

namespace reflines {

// Throws InvalidInput where Catmull-Clark refinement of the cage, to any level, makes a vertex with more faces than
// both 16 and the most edges M at a vertex. OpenSubdiv 3.4 to 3.6 overruns its buffers there (PrimvarRefinerReal::limit
// has room for 1 + 2 M indices and 3 (1 + 2 M) weights, at least 33 and 99): it assumes no more faces than edges around
// a vertex, which only non-manifold vertices violate. Manifold cages, and single edges of up to 8 faces, always pass.
// Loop's masks have no weights of faces. O(#corners log #corners).
void check_mask_room(const Cage& cage);

}  // namespace reflines
