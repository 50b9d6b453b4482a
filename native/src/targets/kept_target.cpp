#include "reflines/kept_target.h"

namespace reflines {

Target build_kept_target(const RegionField& field) {
  return {field.gradient, Vector::Constant(field.F.rows(), kKeptWeight), {}, field.family, false};
}

}  // namespace reflines
