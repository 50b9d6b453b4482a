#include "optimization/wording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reflines/errors.h"

namespace reflines {

std::string format_sentence(const char* format, double first, double second) {
  char text[256];
  std::snprintf(text, sizeof text, format, first, second);
  return text;
}

std::string describe_small_gradient(double norm, double wanted) {
  return format_sentence("The projected gradient is down to %.3g; %.3g was wanted.", norm, wanted);
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

HessianModel choose_model(Strategy strategy) {
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

void report_digits(Progress* progress, const char* stage, double norm_before, double norm, double wanted_norm) {
  if (progress == nullptr) return;
  const double digits = std::log(norm_before / norm);
  const double digits_wanted = std::log(norm_before / wanted_norm);
  const double fraction = digits_wanted > 0.0 ? std::clamp(digits / digits_wanted, 0.0, 1.0) : 0.0;
  progress->report(std::max(fraction, progress->fraction()), stage);
}

}  // namespace reflines
