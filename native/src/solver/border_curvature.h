// Continues the curvature of the surroundings into a region, so that reflection lines run across the border without a
// kink.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflection/reflection_function.h"
#include "reflines/surroundings.h"
#include "reflines/target.h"

namespace reflines {

struct BorderCurvature {
  // One for the first family and one for the last, which crosses it: beside the border the gradients of theta that the
  // surroundings have there, with weights that grow without bound towards it. Rows follow the region's triangles (#F).
  // Empty where no vertex has a known curvature.
  std::vector<Target> targets;
  int unknown = 0;  // vertices whose surroundings do not tell it: they are clamped only
};

// Builds the targets of the border vertices with Border::kCurvature. Slopes and second derivatives of the surroundings
// at such a vertex are those of a polynomial (see fit_heights) through three rings of their vertices around it and
// nothing of the region but its border. The pull reaches six edges, or a tenth of the region's diagonal where that is
// more, and no further than the next crease; its weight falls with the inverse square of the distance. Among fields
// whose second derivatives differ from the wanted ones at the border by a jump, such a weight leaves those that depart
// from the border's like the square of the distance: prescribing them on the border alone would change nothing, for it
// has no area.
BorderCurvature continue_curvature(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                                   const Surroundings& around, const ImagePlane& frame, int triangle_count,
                                   const std::vector<ReflectionFunction>& families);

}  // namespace reflines
