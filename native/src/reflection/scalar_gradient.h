// Computes the gradient of the linear function with given values at a triangle's corners (eq. 5).
#pragma once

#include "reflines/types.h"

namespace reflines {

// Returns the gradient of the linear function whose values at corners b and c exceed that at a by db and dc. xy is #V x
// 2; `corners` are a, b, c.
Vector2 linear_gradient(const PlanePositions& xy, const Eigen::RowVector3i& corners, double db, double dc);

}  // namespace reflines
