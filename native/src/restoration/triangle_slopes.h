// The slopes of a height field on its triangles.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the slopes (#F x 2) of heights z (#V) on triangles F of vertices xy (#V x 2) in the image plane.
PlaneVectors find_slopes(const PlanePositions& xy, const Triangles& F, const Vector& z);

}  // namespace reflines
