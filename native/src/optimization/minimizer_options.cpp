#include "reflines/minimizer_options.h"

namespace reflines {

const char* to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::kAdaptive:
      return "adaptive";
    case Strategy::kLinearized:
      return "linearized";
    case Strategy::kGaussNewton:
      return "gauss_newton";
    case Strategy::kNewton:
      return "newton";
  }
  return "";
}

}  // namespace reflines
