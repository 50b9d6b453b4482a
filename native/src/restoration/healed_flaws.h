// Measures what a press healed and where: how far lines were from their course, and how far they are now.
#pragma once

#include "reflines/smooth_panel.h"
#include "reflines/types.h"
#include "restoration/controlled_surface.h"

namespace reflines {

// Returns how far the lines of heights z (#V) are from those of the heights `course` (#V) around each triangle (#F):
// degrees of theta, root mean square over a disk, in the light in which that is most. `length` is the size of flaws.
Vector measure_deviation(ControlledSurface& surface, const Vector& z, const Vector& course, double length);

// Sums deviations (#F) before and after a press up; `area` (#F) is that of the triangles.
HealedFlaws compare_deviations(const Vector& before, const Vector& after, const Vector& area);

}  // namespace reflines
