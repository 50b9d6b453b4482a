// Waves that are longer than the flaws that a press takes out.
#pragma once

#include <vector>

namespace reflines {

// The length, relative to that of the flaws, up to which the lines are smoothed to see longer waves.
inline constexpr double kLongerReach = 4.0;

// Returns whether some light shows waves that a press with twice the length may take for flaws. `within` and `longer`
// hold a number for each light, in radians per unit of `length`: the median over area of how far the lines' field is
// from itself smoothed up to the length, and up to kLongerReach times that.
bool has_longer_waves(const std::vector<double>& within, const std::vector<double>& longer, double length);

}  // namespace reflines
