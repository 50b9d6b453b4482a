#include "optimization/refactor_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflines {

namespace {

// The cost of one assembly and factorization in steps (a solve, an evaluation, the quasi-Newton products): 22 to 28
// were measured from 10k to 1M unknowns.
constexpr double kStepsPerFactorization = 25.0;

// The expected number of steps to the last digits with a fresh factor.
constexpr double kStepsAfterFactorization = 5.0;

}  // namespace

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
  return digits_to_go > (kStepsPerFactorization + kStepsAfterFactorization) * digits_per_step;
}

}  // namespace reflines
