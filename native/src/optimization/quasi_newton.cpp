#include "optimization/quasi_newton.h"

#include <algorithm>

namespace reflines {

namespace {

// The number of pairs kept: on the bump problems 20 pairs saved no more than two steps in 28 over 8 pairs.
constexpr std::size_t kPairs = 8;

// The curvature of a pair relative to its lengths below which it is rounding.
constexpr double kSmallestCurvature = 1e-14;

}  // namespace

void QuasiNewtonMemory::resize(Eigen::Index n) {
  pairs_.resize(kPairs);
  for (Pair& pair : pairs_) {
    pair.step.resize(n);
    pair.gradient_change.resize(n);
  }
  clear();
}

void QuasiNewtonMemory::before_solve(Vector& direction) {
  for (int age = 0; age < count_; ++age) {
    Pair& p = pair(age);
    p.weight = p.step.dot(direction) / p.curvature;
    direction.noalias() -= p.weight * p.gradient_change;
  }
}

void QuasiNewtonMemory::after_solve(Vector& direction) const {
  for (int age = count_ - 1; age >= 0; --age) {
    const Pair& p = pair(age);
    const double correction = p.gradient_change.dot(direction) / p.curvature;
    direction.noalias() += (p.weight - correction) * p.step;
  }
}

void QuasiNewtonMemory::learn(const Vector& step, const Vector& gradient_change) {
  const double curvature = step.dot(gradient_change);
  if (!(curvature > kSmallestCurvature * step.norm() * gradient_change.norm())) return;
  newest_ = (newest_ + 1) % pairs_.size();
  count_ = std::min(count_ + 1, static_cast<int>(pairs_.size()));
  Pair& p = pair(0);
  p.step = step;
  p.gradient_change = gradient_change;
  p.curvature = curvature;
}

}  // namespace reflines
