// What a solve costs, in counts: the regression gate for speed, the same on every machine.
#include <gtest/gtest.h>

#include "least_squares.h"
#include "optimization/minimizer.h"

namespace reflines {
namespace {

struct CostTest : testing::Test {
  CostTest() : problem(300, 0.2), x(problem.wave(0.9)) { problem.set_minimum(problem.wave(1.0)); }

  Chain problem;
  Vector x;
  Minimizer minimizer;
};

TEST_F(CostTest, AnotherSizeOrStrategyIsNoticed) {
  minimizer.minimize(problem, x);
  Chain longer(400, 0.2);
  longer.set_minimum(longer.wave(1.0));
  Vector x = longer.wave(0.9);
  const Report report = minimizer.minimize(longer, x);
  EXPECT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.analyses, 1);
  MinimizerOptions options;
  options.strategy = Strategy::kNewton;
  x = longer.wave(0.9);
  const Report newton = minimizer.minimize(longer, x, options);
  EXPECT_TRUE(newton.converged()) << newton.message;
  EXPECT_EQ(newton.analyses, 0);
  EXPECT_EQ(newton.factorizations, newton.iterations);
}

TEST_F(CostTest, AFactorThatMisleadsIsRenewedAtOnce) {
  Rosenbrock valley(50);
  Vector x = valley.start();
  MinimizerOptions options;
  options.max_iterations = 1000;
  const Report report = minimizer.minimize(valley, x, options);
  ASSERT_TRUE(report.converged()) << report.message;
  EXPECT_GT(report.factorizations, 1);
  EXPECT_EQ(report.analyses, 1);
}

}  // namespace
}  // namespace reflines
