// What a solve costs, in counts: the regression gate for speed, the same on every machine.
#include <gtest/gtest.h>

#include <cstdint>

#include "least_squares.h"
#include "optimization/minimizer.h"
#include "tests/native/allocations.h"

namespace reflines {
namespace {

struct CostTest : testing::Test {
  CostTest() : problem(300, 0.2), x(problem.wave(0.9)) { problem.set_minimum(problem.wave(1.0)); }

  Chain problem;
  Vector x;
  Minimizer minimizer;
};

TEST_F(CostTest, AnEasyProblemIsFactoredOnceAndEveryStepIsOneEvaluationAndOneSolve) {
  const Report report = minimizer.minimize(problem, x);
  ASSERT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.analyses, 1);
  EXPECT_EQ(report.assemblies, 1);
  EXPECT_EQ(report.factorizations, 1);
  EXPECT_EQ(report.solves, report.iterations);
  EXPECT_EQ(report.evaluations, report.iterations + 1);
}

TEST_F(CostTest, AWarmSolveReusesAnalysisAndFactor) {
  minimizer.minimize(problem, x);
  problem.set_minimum(problem.wave(1.02));
  const Report warm = minimizer.minimize(problem, x);
  ASSERT_TRUE(warm.converged()) << warm.message;
  EXPECT_EQ(warm.analyses, 0);
  EXPECT_EQ(warm.assemblies, 0);
  EXPECT_EQ(warm.factorizations, 0);
}

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

TEST_F(CostTest, StepsAllocateNothing) {
  if (!kAllocationsAreCounted) GTEST_SKIP() << "this build's malloc cannot be counted";
  minimizer.minimize(problem, x);
  std::int64_t used[2];
  for (int run = 0; run < 2; ++run) {
    problem.set_minimum(problem.wave(1.02 + 0.02 * run));
    MinimizerOptions options;
    options.gradient_tolerance = 0.0;
    options.max_iterations = run == 0 ? 1 : 4;
    const std::int64_t before = allocations.load();
    const Report report = minimizer.minimize(problem, x, options);
    used[run] = allocations.load() - before;
    ASSERT_EQ(report.iterations, options.max_iterations) << report.message;
    ASSERT_EQ(report.factorizations, 0);
  }
  EXPECT_EQ(used[0], used[1]);
}

}  // namespace
}  // namespace reflines
