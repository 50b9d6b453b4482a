// The cubic that leads smoothly from 0 to 1 (Hermite's smoothstep): a yes or no without a jump.
#pragma once

#include <algorithm>

namespace reflines {

// Returns 0 at `low` and beyond, 1 at `high` and beyond; `low` may be the larger of the two.
inline double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace reflines
