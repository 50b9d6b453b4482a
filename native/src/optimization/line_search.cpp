#include "optimization/line_search.h"

#include <algorithm>
#include <cmath>

namespace reflines {

namespace {

constexpr double kArmijo = 1e-4;

// The relative rounding of the energy's sum, below which its changes near the minimum carry no information while the
// slope still does.
constexpr double kEnergyRounding = 1e-10;
constexpr double kSlopeReduction = 0.9;

}  // namespace

bool lowers_energy_enough(const LinePoint& start, const LinePoint& trial) {
  if (!std::isfinite(trial.energy) || !std::isfinite(trial.slope)) return false;
  if (trial.energy <= start.energy + kArmijo * trial.step * start.slope) return true;
  const bool same_energy = trial.energy <= start.energy + kEnergyRounding * std::abs(start.energy);
  return same_energy && std::abs(trial.slope) <= kSlopeReduction * std::abs(start.slope);
}

double shorter_step(const LinePoint& start, const LinePoint& trial) {
  const double t = trial.step;
  const double excess = trial.energy - start.energy - t * start.slope;  // above the tangent; > 0 for a refused step
  if (!std::isfinite(excess) || !(excess > 0.0)) return 0.1 * t;
  return std::clamp(-start.slope * t * t / (2.0 * excess), 0.1 * t, 0.5 * t);
}

}  // namespace reflines
