// Targets that smooth the lines (paper, section 4, "Smoothing").
#pragma once

#include <functional>

#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

struct SmoothOptions {
  double length = 0.0;       // wavelength that is halved, in the mesh's unit of length; 0 changes nothing
  bool directional = false;  // only along the lines: they become straight, their spacing across stays
};

// A function that returns a region's field of gradients (#F x 2) without its detail finer than options.length; see
// ShapeOptimizer::smoother.
using FieldSmoother = std::function<PlaneVectors(const SmoothOptions&)>;

// Builds the target that blends the field `gradient` (#F x 2) of a family, by `strength` in [0, 1], with its smoothed
// field. Strength 0 and length 0 keep the field bit for bit without a call of the smoother. Throws InvalidInput: a
// length that is negative or not finite, a strength outside [0, 1].
Target build_smooth_target(const PlaneVectors& gradient, const FieldSmoother& smoother, const SmoothOptions& options,
                           double strength, int family);

}  // namespace reflines
