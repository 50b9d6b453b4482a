#include "reflines/smooth_target.h"

#include <cmath>

#include "reflines/errors.h"

namespace reflines {

Target build_smooth_target(const PlaneVectors& gradient, const FieldSmoother& smoother, const SmoothOptions& options,
                           double strength, int family) {
  if (!(options.length >= 0) || !std::isfinite(options.length)) {
    throw InvalidInput("The smoothing length must be a positive length in scene units.");
  }
  if (!(strength >= 0 && strength <= 1)) throw InvalidInput("The strength must lie between 0 and 1.");
  Target target{gradient, {}, {}, family};
  if (strength > 0 && options.length > 0) target.gradient += strength * (smoother(options) - gradient);
  return target;
}

}  // namespace reflines
