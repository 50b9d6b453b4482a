// Counts of faces as the artist has them, from masks of the triangles that they were cut into.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the number of faces that have a triangle in the mask (#F). `face_of_triangle`: see ShapeOptions.
int count_faces(const Mask& triangles, const IndexVector& face_of_triangle);

}  // namespace reflines
