// A threshold without a jump.
#pragma once

#include "base/smoothstep.h"

namespace reflines {

// The factor between a threshold and the ends of its smoothstep: from 0.82 to 1.22 thresholds.
inline constexpr double kSoftness = 1.22;

// Returns how surely x > 0 is above a threshold, 0 to 1; half is reached just above it.
inline double soft_step(double threshold, double x) {
  return smoothstep(threshold / kSoftness, threshold * kSoftness, x);
}

// Returns the lowest x of which soft_step is not 0.
inline double begin_of_soft_step(double threshold) { return threshold / kSoftness; }

}  // namespace reflines
