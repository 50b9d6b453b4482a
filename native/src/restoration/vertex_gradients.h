// The gradients of a field of heights at the vertices of its triangles.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the gradient of heights z (#V) at each vertex (#V x 2) of triangles F over places xy (#V x 2): the mean of
// its triangles' by area.
PlanePositions find_vertex_gradients(const PlanePositions& xy, const Triangles& F, const Vector& z);

}  // namespace reflines
