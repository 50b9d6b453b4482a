// Triangles that a move along the view turns too far.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the triangles (#F) whose normals moves (#V) along the axis turn by more than 45 degrees.
Mask find_turned(const Vector3& axis, const Positions& V, const Triangles& F, const Vector& move);

// Returns the vertices (#V of `vertex_count`) of these triangles (#F).
Mask find_corners(const Triangles& F, const Mask& triangles, Eigen::Index vertex_count);

}  // namespace reflines
