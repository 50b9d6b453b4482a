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
// the border alone would change nothing, for it has no area. With kCurvature the wanted derivatives are those at the
// border; with kFlow those of the polynomial at each triangle, and what departs like d^2 leaves their rate at the
// border.
//
// Creases are those of the region or, where its rule is that there are none, those found by their bend: no curvature
// continues across one. Nor does it where lines bend strongly: the weight is multiplied by the response (see
// measure_response) to the lines at the start, in both families, and to those wanted, and the pull ends where the
// former vanishes. `start` holds the lines of the first family and of the last one.
BorderCurvature continue_curvature(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                                   const Surroundings& around, const ImagePlane& frame, const CreaseOptions& creases,
                                   const std::vector<StartLines>& start,
                                   const std::vector<ReflectionFunction>& families);

}  // namespace reflines
