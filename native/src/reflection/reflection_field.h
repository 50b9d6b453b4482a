// Computes theta and its gradient for each triangle of a surface.
#pragma once

#include "geometry/derivatives.h"
#include "reflection/reflection_function.h"
#include "reflines/types.h"

namespace reflines {

struct ReflectionField {
  Vector theta;           // #T, radians in (-pi, pi]
  PlaneVectors gradient;  // #T x 2, radians / length, in the image plane; free of 2 pi jumps
};

ReflectionField reflection_field(const ReflectionFunction& reflection, const TriangleDerivatives& u);

// Returns the gradient alone, in two thirds of the time.
PlaneVectors gradient_field(const ReflectionFunction& reflection, const TriangleDerivatives& u);

// Returns the weight of each triangle (#T): 1 where the reflected ray is well away from the lines (visibility 0.05 and
// more), 0 where it is parallel to them and theta is undefined: there grad theta has a pole, and one triangle would
// outweigh the panel.
Vector visibility_weights(const ReflectionFunction& reflection, const TriangleDerivatives& u);

}  // namespace reflines
