// Fits the surface around each place of a height field: polynomials over disks by robust regression (Cleveland 1979,
// "Robust locally weighted regression and smoothing scatterplots"), blended by a partition of unity.
#pragma once

#include "geometry/height_field.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// Returns the heights (#V) of blended polynomials of degree 4 over disks of this radius; those of the field itself
// where there are too few vertices for a fit. A dent that is a sixth as wide as a disk is hardly a part of its
// polynomial. A field that is such a polynomial keeps its heights up to its border, however it is cut into triangles.
// `progress` may be null; throws Cancelled.
Vector fit_local_surface(const HeightField& field, double radius, const Progress* progress);

}  // namespace reflines
