// The lines that a press solves for: smoothed up to the flaws' length, further where flaws are wider, and kept where
// that would change the design.
#pragma once

#include "reflines/types.h"
#include "restoration/controlled_surface.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {

// Returns `fields` (#F x m) without noise and ripples: at each place smoothed as far as flaws reach (see
// length_choice.h), and by the weight of that change as a flaw (see flaw_weight.h). `creases` are those of the fields,
// `length` is that of flaws.
TriangleFields smooth_lines(ControlledSurface& surface, const CreasePreservingSmoother& smoother, const Vector& creases,
                            const TriangleFields& fields, double length);

}  // namespace reflines
