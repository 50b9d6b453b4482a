// The room that OpenSubdiv's limit evaluation has for the masks of non-manifold vertices.
#pragma once

#include "reflines/cage.h"

namespace reflines {

// Throws InvalidInput where Catmull-Clark refinement of the cage, to any level, makes a vertex with more faces than
// both 16 and the most edges M at a vertex. OpenSubdiv 3.4 to 3.6 overruns its buffers there (PrimvarRefinerReal::limit
// has room for 1 + 2 M indices and 3 (1 + 2 M) weights, at least 33 and 99): it reckons with no more faces than edges
// round a vertex, which only non-manifold ones have. Manifold cages, and edges of up to 8 faces by themselves, always
// pass. Loop's masks have no weights of faces. O(#corners log #corners).
void check_mask_room(const Cage& cage);

}  // namespace reflines
