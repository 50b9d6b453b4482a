#include "restoration/longer_waves.h"

#include <cstddef>
#include <numbers>

namespace reflines {
namespace {

// The ratio by which lines stray farther from their course over the longer length than from that over the length of
// flaws, both in degrees over their own length: 3 to 8 on clean panels, 9 to 18 with waves of three and four lengths
// that can be seen, of which a press leaves nine tenths.
constexpr double kMuchMore = 9.0;

// Degrees over the longer length, between which lines stray by waves that can be seen and may be flaws. Strays of clean
// designs with as many waves are 30 to 120: lamps' edges, flutes, and a bonnet with a scoop.
constexpr double kVisible = 1.0, kShallow = 20.0;

}  // namespace

bool has_longer_waves(const std::vector<double>& within, const std::vector<double>& longer, double length) {
  for (std::size_t k = 0; k < longer.size(); ++k) {
    const double stray = kLongerReach * length * longer[k] * 180.0 / std::numbers::pi;
    const bool is_much_more = kLongerReach * longer[k] > kMuchMore * within[k];
    if (is_much_more && stray > kVisible && stray < kShallow) return true;
  }
  return false;
}

}  // namespace reflines
