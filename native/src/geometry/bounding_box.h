// The axis-aligned bounding box of positions.
#pragma once

#include <Eigen/Geometry>

#include "reflines/types.h"

namespace reflines {

double bounding_box_diagonal(const Positions& V);  // #V x 3, not empty

// Returns the box around the faces of V (#V x 3), F (#F x 3). Vertices in no face may be anywhere.
Eigen::AlignedBox3d find_bounding_box(const Positions& V, const Triangles& F);

}  // namespace reflines
