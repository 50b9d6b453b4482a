// When a factor of another point is replaced.
#include <gtest/gtest.h>

#include "optimization/refactor_policy.h"

namespace reflines {
namespace {

// Follows gradient norms that shrink by a factor in each of these steps, from 1 on.
RefactorPolicy follow(RefactorPolicy policy, double factor, int steps, double target) {
  policy.start(1.0, target);
  double norm = 1.0;
  for (int k = 0; k < steps; ++k) policy.observe(norm *= factor);
  return policy;
}

// Halved in each step, a gradient of 1/8 takes 23.6 steps more down to 1e-8, and 10.3 down to 1e-4.
TEST(RefactorPolicy, ComparesTheStepsThatAreLeftWithAFactorization) {
  EXPECT_TRUE(follow(RefactorPolicy(20, 3), 0.5, 3, 1e-8).is_too_slow());
  EXPECT_FALSE(follow(RefactorPolicy(21, 3), 0.5, 3, 1e-8).is_too_slow());
  EXPECT_TRUE(follow(RefactorPolicy(5, 1), 0.5, 3, 1e-4).is_too_slow());
  EXPECT_FALSE(follow(RefactorPolicy(), 0.5, 3, 1e-4).is_too_slow());
}

TEST(RefactorPolicy, WaitsForAFewSteps) {
  EXPECT_FALSE(follow(RefactorPolicy(5, 1), 0.999, 2, 1e-8).is_too_slow());
  EXPECT_TRUE(follow(RefactorPolicy(5, 1), 0.999, 3, 1e-8).is_too_slow());
}

// Gradients of oscillating steps count by their mean rate.
TEST(RefactorPolicy, IsNotMisledByOneStep) {
  RefactorPolicy policy(5, 1);
  policy.start(1.0, 1e-6);
  for (const double norm : {0.05, 0.08, 0.001}) policy.observe(norm);
  EXPECT_FALSE(policy.is_too_slow());
}

TEST(RefactorPolicy, BeginsAnewWithEveryFactor) {
  RefactorPolicy policy(5, 1);
  policy.start(1.0, 1e-8);
  for (int k = 0; k < 5; ++k) policy.observe(1.0);
  EXPECT_TRUE(policy.is_too_slow());
  policy.start(1.0, 1e-8);
  EXPECT_FALSE(policy.is_too_slow());
}

}  // namespace
}  // namespace reflines
