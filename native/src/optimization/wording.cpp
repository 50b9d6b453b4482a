#include "optimization/wording.h"

#include <cmath>
#include <cstdio>

#include "reflines/errors.h"

namespace reflines {

std::string sentence(const char* format, double first, double second) {
  char text[256];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

void check_start(Eigen::Index values, int unknowns) {
  if (values == unknowns) return;
  throw InvalidInput("The start has " + std::to_string(values) + " values for " + std::to_string(unknowns) +
                     " unknowns; hand over one value per unknown.");
}

void check_start(double energy, double gradient_norm) {
  if (std::isfinite(energy) && std::isfinite(gradient_norm)) return;
  throw InvalidInput("The energy at the start is not finite; remove folded or degenerate triangles from the region.");
}

HessianModel model_of(Strategy strategy) {
  switch (strategy) {
    case Strategy::kLinearized:
      return HessianModel::kLinearized;
    case Strategy::kNewton:
      return HessianModel::kNewton;
    case Strategy::kGaussNewton:
    case Strategy::kAdaptive:
      break;
  }
  return HessianModel::kGaussNewton;
}

}  // namespace reflines
