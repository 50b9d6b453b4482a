#include "restoration/press_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "reflines/errors.h"
#include "solver/limited_move.h"

namespace reflines {
namespace {

// Throws unless there are fractions of the limit for all vertices, or for none.
void check_fraction(const MoveLimit& fraction, Eigen::Index vertex_count) {
  if (!fraction.exists() && fraction.lowest.size() == 0) return;
  check(fraction, static_cast<int>(vertex_count));
  const auto beyond = (fraction.lowest.array() < -1 || fraction.highest.array() > 1).count();
  if (beyond == 0) return;
  throw InvalidInput("The share of the limit of " + std::to_string(beyond) + " of the " + std::to_string(vertex_count) +
                     " vertices is beyond it; give -1 to 0 for the lowest move and 0 to 1 for the highest.");
}

void check_mask(const Mask& mask, const std::string& name, Eigen::Index vertex_count) {
  if (mask.size() == 0 || mask.size() == vertex_count) return;
  throw InvalidInput("The " + name + " mask has " + std::to_string(mask.size()) + " entries for " +
                     std::to_string(vertex_count) + " vertices; give one for each.");
}

void require(bool holds, const char* otherwise) {
  if (!holds) throw InvalidInput(otherwise);
}

void check_set(const LightSet& set) {
  const size_t lights = set.line_directions.size();
  if (!set.weight.empty() && set.weight.size() != lights) {
    throw InvalidInput("The set of lights has " + std::to_string(set.weight.size()) + " weights for " +
                       std::to_string(lights) + " lights; give one for each, or none.");
  }
  const bool fit = std::all_of(set.weight.begin(), set.weight.end(),
                               [](double weight) { return weight >= 0 && std::isfinite(weight); });
  require(fit, "A weight of the set of lights is negative or not a finite number; give 0 or more.");
  const bool none = !set.weight.empty() &&
                    std::all_of(set.weight.begin(), set.weight.end(), [](double weight) { return weight == 0; });
  require(!none, "All lights of the set have weight 0; give one of them more.");
}

}  // namespace

void check_amount(const PressAmount& amount, Eigen::Index vertex_count) {
  require(amount.limit >= 0, "The limit must be a positive length, or 0 for automatic.");
  require(amount.strength >= 0 && amount.strength <= 1, "The strength must lie between 0 and 1.");
  check_fraction(amount.limit_range, vertex_count);
}

void check_press_options(const SmoothPanelOptions& options, Eigen::Index vertex_count) {
  require(options.length >= 0 && std::isfinite(options.length),
          "The length must be a positive length, or 0 for automatic.");
  // The search for bumps grows their radius from a part of the length, which stands still where that rounds.
  require(options.length == 0 || options.length >= std::numeric_limits<double>::min(),
          "The length is too small to compute with; give a longer one, or 0 for automatic.");
  require(options.parts_gap >= 0 && std::isfinite(options.parts_gap),
          "The gap between parts must be a positive length, or 0 for automatic.");
  require(options.flaw_size > 0 && std::isfinite(options.flaw_size), "The flaw size must be a number above 0.");
  if (!options.border.empty() && static_cast<Eigen::Index>(options.border.size()) != vertex_count) {
    throw InvalidInput("There are " + std::to_string(options.border.size()) + " border codes for " +
                       std::to_string(vertex_count) + " vertices; give one for each.");
  }
  check_mask(options.held, "held", vertex_count);
  check_mask(options.fair_border, "fair border", vertex_count);
  check_set(options.set);
  const bool blind = options.judges.exist() && !options.judges.eyes.exist();
  require(!blind, "Lights that judge a press need eye directions; give one for each.");
}

}  // namespace reflines
