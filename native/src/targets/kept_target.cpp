#include "reflines/kept_target.h"

namespace reflines {

Target build_kept_target(const PlaneVectors& gradient, int family) {
  return {gradient, Vector::Constant(gradient.rows(), kKeptWeight), {}, family, false};
}

}  // namespace reflines
