// The reflection lines a surface has: theta and its gradient for every triangle.
#pragma once

#include "native/geometry/derivatives.h"
#include "native/reflection/reflection_function.h"
#include "native/types.h"

namespace reflines {

struct ReflectionField {
  Vector theta;           // #T, radians in (-pi, pi]
  PlaneVectors gradient;  // #T x 2, radians / length, in the image plane; without 2 pi jumps
  Vector visibility;      // #T: sine of the angle between reflected ray and lines; theta is undefined where it is 0
};

ReflectionField reflection_field(const ReflectionFunction& reflection, const TriangleDerivatives& u);

// Weight of a triangle by its visibility, 1 from 0.05 up and 0 where theta is undefined: there grad theta has a pole,
// and one triangle would outweigh the panel.
double visibility_weight(double visibility);

}  // namespace reflines
