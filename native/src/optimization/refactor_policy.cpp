#include "optimization/refactor_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflines {

void RefactorPolicy::start(double gradient_norm, double target) {
  norms_.back() = gradient_norm;
  count_ = 1;
  target_ = std::max(target, std::numeric_limits<double>::epsilon() * gradient_norm);  // no solve gains more digits
}

void RefactorPolicy::observe(double gradient_norm) {
  std::shift_left(norms_.begin(), norms_.end(), 1);
  norms_.back() = gradient_norm;
  count_ = std::min(count_ + 1, kWindow);
}

bool RefactorPolicy::is_too_slow() const {
  if (count_ < kWindow) return false;
  const double digits_per_step = std::log(norms_.front() / norms_.back()) / (kWindow - 1);
  const double digits_to_go = std::log(norms_.back() / target_);
  return digits_to_go > (steps_per_factorization_ + steps_after_) * digits_per_step;
}

}  // namespace reflines
