// The panel of a cage in a press of several.
#pragma once

#include <vector>

#include "reflines/joint_smoother.h"

namespace reflines {

struct CagePanel {
  JointPanel panel;    // V, F, border and surroundings are those of the cage's surface
  IndexVector corner;  // #V: the cage's vertex whose place on the surface each is, or -1
};

// Returns a panel with a cage as one of that cage's surface. Throws InvalidInput as CageOptimizer does.
CagePanel read_surface(const JointPanel& panel);

// Returns the cage with a border that is free where vertices of its surface (#V) are marked, and continues no lines.
JointCage free_border(JointCage cage, const IndexVector& corner, const Mask& marked);

}  // namespace reflines
