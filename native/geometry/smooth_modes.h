// Bicubic B-splines over the image plane as motions of the free vertices: what a change of shape looks like from afar.
#pragma once

#include "native/geometry/height_field.h"
#include "native/types.h"

namespace reflines {

// m x n, one column for each free vertex in order, at most 16 entries each: by how much the m splines move it. The
// knots lie about `spacing` mean vertex distances apart. A spline that would move a vertex which is not free is left
// out, so that borders keep their position and tangent; so is one that moves next to nothing. May have no row at all.
SparseMatrix smooth_modes(const HeightField& field, double spacing);

}  // namespace reflines
