// Measures how far lines are from their course on the triangles of a surface, in one light from one eye.
#pragma once

#include "reflection/reflection_function.h"
#include "reflines/types.h"

namespace reflines {

// Returns the squared difference of theta (#F, degrees^2) between slopes and those of the course (#F x 2 each), times
// `sight` (#F, 0 to 1: how well the eye sees each triangle). Where lines have no course it counts less.
Vector measure_departure(const ReflectionFunction& light, const PlaneVectors& slopes, const PlaneVectors& course,
                         const Vector& sight);

}  // namespace reflines
