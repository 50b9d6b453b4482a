// Measures of a stencil of second derivatives: how it amplifies noise, and how it errs where heights are no quadratic.
#pragma once

#include "geometry/stencil.h"

namespace reflines {

// Returns the paper's measure of instability: the largest |weight| times l_max^2, l_max the longest edge of the
// six-point stencil.
double stencil_magnitude(const HeightField& field, const HessianStencil& stencil);

// Returns an affinely invariant measure of instability: the largest Frobenius norm of a point's Hessian weights in the
// coordinates in which the points have the unit covariance. It is 0.9 for the six points of a regular mesh, however
// stretched.
double affine_magnitude(const HeightField& field, const HessianStencil& stencil);

// Returns the largest error of the second derivatives of a cubic whose third derivatives are 1, relative to the largest
// distance of a point from the centroid of triangle t: 0.5 for the six points of a regular mesh, however stretched
// along its axes. Points that do not lie in rows give the second derivative along the short side h of the cells the
// third derivative along the long side H, times H^3 / h^2.
double cubic_error(const HeightField& field, int t, const HessianStencil& stencil);

}  // namespace reflines
