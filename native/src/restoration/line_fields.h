// The fields of the lines of all lights: the gradients of their reflection functions on triangles.
#pragma once

#include <vector>

#include "reflines/shape_optimizer.h"
#include "reflines/types.h"
#include "restoration/triangle_fields.h"

namespace reflines {

// Returns the fields (#F x 2 #families, radians / length) of the optimizer's surface with heights z (#V).
TriangleFields read_fields(ShapeOptimizer& optimizer, const Vector& z);

// Returns the targets of a solve for these fields, one for each family of lights; `weight` is that of each, or empty.
std::vector<Target> make_targets(const TriangleFields& fields, const std::vector<double>& weight);

}  // namespace reflines
