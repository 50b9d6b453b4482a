// The slopes of a height field on its triangles and at their vertices.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the slopes (#F x 2) of heights z (#V) on triangles F of vertices xy (#V x 2) in the image plane.
PlaneVectors find_slopes(const PlanePositions& xy, const Triangles& F, const Vector& z);

// Returns the slope (#V x 2) at each vertex: the mean of its triangles' by area.
PlanePositions find_vertex_gradients(const PlanePositions& xy, const Triangles& F, const Vector& z);

}  // namespace reflines
