// Continues the curvature of the surroundings into a region, so that reflection lines run across the border without a
// kink.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflection/reflection_function.h"
#include "reflines/surroundings.h"
#include "reflines/target.h"

namespace reflines {

// The lines of a family in the region at the start.
struct StartLines {
  PlaneVectors gradient;  // #F x 2
  double strong = 0;      // the size of a strong bend, see find_strong_size
};

struct BorderCurvature {
  // One for the first family and one for the last, which crosses it: beside the border the gradients of theta that the
  // surroundings have there, with weights that grow without bound towards it. Rows follow the region's triangles (#F).
  // Empty where no vertex has a known curvature, or the lines bend too strongly everywhere.
  std::vector<Target> targets;
  int unknown = 0;   // vertices whose surroundings do not tell it: they are clamped only
  int strong = 0;    // vertices beside which the lines bend too strongly, inside or outside: they are clamped only
  int constant = 0;  // vertices with Border::kFlow whose surroundings do not tell its rate: it is kept constant there
};

// Builds the targets of the border vertices with Border::kCurvature and kFlow, from what fit_border_jets tells. The
// pull reaches six edges, or a tenth of the region's diagonal where that is more, and no further than the next crease;
// its weight falls with the inverse square of the distance d. Among fields whose second derivatives differ from the
// wanted ones at the border by a jump, such a weight leaves those that depart from the border's: prescribing them on
// the border alone would change nothing, for it has no area.
//
// Where the pull with weight d^-2 meets another target with weight 1, the minimum departs from the pull like d^2 if the
// pull is smooth. With kCurvature the wanted derivatives are those at the border, and the true ones already depart from
// these like d; with kFlow they are those of the polynomial at each triangle, and what departs like d^2 leaves their
// rate at the border. A weight of d^-4 follows the polynomial further and leaves it more suddenly: with exact
// derivatives, on 96 x 96 jittered cells, the rate ends 6.4 and 3.3 beside that of the surroundings (a dent, ripples)
// instead of 3.7 and 2.0.
//
// Creases are those of the region or, where its rule is that there are none, those found by their bend: presses of
// Smooth hold no crease, but no curvature continues across one. Nor does it where lines bend strongly: the weight is
// multiplied by the response (see measure_response) to the lines at the start, in both families, and to those wanted,
// and the pull ends where the former vanishes. `start` holds the lines of the first family and of the last one. On a
// car's door selected with its sill, where lines stray by 12.1 and 8.9 degrees in the two lights, a press with
// kCurvature moved vertices to the limit, left 14.6 and 12.7 and took 30 s. Creases leave 12.1 and 8.9 (nothing was
// healed), the response to the start 13.9 and 11.2, both 12.3 and 9.2, and with the response to the wanted lines they
// leave 11.4 and 8.3 in 0.3 s, as a clamped border does. A strong bend of half and of twice the size for the wanted
// lines: 11.4 and 8.3, 11.5 and 8.4; with kFlow 11.4 and 8.3, 12.1 and 9.1.
BorderCurvature continue_curvature(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                                   const Surroundings& around, const ImagePlane& frame, const CreaseOptions& creases,
                                   const std::vector<StartLines>& start,
                                   const std::vector<ReflectionFunction>& families);

}  // namespace reflines
