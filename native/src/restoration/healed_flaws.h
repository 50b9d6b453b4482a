// Measures what a press healed and where: how far lines were from their course, and how far they are now.
#pragma once

#include "reflines/smooth_panel.h"
#include "reflines/types.h"
#include "restoration/controlled_surface.h"

namespace reflines {

struct HealedPlaces {
  HealedFlaws flaws;
  Vector fraction;  // #F: how far each triangle counts as healed, 0 to 1
};

// Compares how far the lines of heights `before` and `after` (#V) a press are from those of the heights `course` (#V);
// `length` is the size of flaws, and `judges` are lights that took no part. See HealedFlaws.
HealedPlaces measure_healed(ControlledSurface& surface, const Vector& before, const Vector& after, const Vector& course,
                            double length, const LightSet& judges);

}  // namespace reflines
