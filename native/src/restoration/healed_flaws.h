// Measures what a press healed and where: how far lines were from their course, and how far they are now.
#pragma once

#include "reflines/smooth_panel.h"
#include "reflines/types.h"
#include "restoration/controlled_surface.h"

namespace reflines {

// Compares how far the lines of heights `before` and `after` (#V) a press are from those of the heights `course` (#V);
// `length` is the size of flaws. See HealedFlaws.
HealedFlaws measure_healed(ControlledSurface& surface, const Vector& before, const Vector& after, const Vector& course,
                           double length);

}  // namespace reflines
