// The places at which a press would make lines less even: they stay, and the others are healed.
#pragma once

#include "reflines/types.h"
#include "restoration/controlled_surface.h"

namespace reflines {

// Returns the fraction of its move that each vertex of a mesh (#V) makes, 0 to 1: nothing where the mean square of the
// lines' offset from their course, around it and in any light, would rise to twice that before. `before` and `after`
// (#F x lights, degrees^2) are the squares; `length` is the size of flaws; `partner` (#V, or empty) tells mirror
// images, which make the same fraction.
Vector find_even_places(ControlledSurface& surface, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
                        double length, double raised, const IndexVector& partner);

}  // namespace reflines
