// Every strategy finds the known minima; every way to stop is a value; x is left alone where it must be.
#include <gtest/gtest.h>

#include <limits>

#include "least_squares.h"
#include "optimization/minimizer.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr Strategy kStrategies[] = {Strategy::kAdaptive, Strategy::kLinearized, Strategy::kGaussNewton,
                                    Strategy::kNewton};

MinimizerOptions with(Strategy strategy, double gradient_tolerance = 1e-6, int max_iterations = 100) {
  MinimizerOptions options;
  options.strategy = strategy;
  options.gradient_tolerance = gradient_tolerance;
  options.max_iterations = max_iterations;
  return options;
}

class StrategyTest : public testing::TestWithParam<Strategy> {};

INSTANTIATE_TEST_SUITE_P(Strategies, StrategyTest, testing::ValuesIn(kStrategies),
                         [](const auto& info) { return std::string(to_string(info.param)); });

TEST_P(StrategyTest, FollowsRosenbrocksValley) {
  // The paper's constant matrix creeps along a steep valley: a mild one must do for it.
  Rosenbrock problem(20, GetParam() == Strategy::kLinearized ? 1.0 : 10.0);
  Vector x = problem.start();
  Minimizer minimizer;
  const Report report = minimizer.minimize(problem, x, with(GetParam(), 1e-9, 1000));
  EXPECT_EQ(report.termination, Termination::kConverged) << report.message;
  EXPECT_LT((x - Vector::Ones(problem.size())).norm(), 1e-6);
  EXPECT_LE(report.gradient_after, 1e-9 * report.gradient_before);
}

TEST_P(StrategyTest, FindsTheShapeOfABentChain) {
  Chain problem(60, 0.05);
  const Vector minimum = problem.wave(1.0);
  problem.set_minimum(minimum);
  Vector x = problem.wave(0.7);
  Minimizer minimizer;
  const Report report = minimizer.minimize(problem, x, with(GetParam(), 1e-9, 1000));
  EXPECT_EQ(report.termination, Termination::kConverged) << report.message;
  EXPECT_LT((x - minimum).norm(), 1e-6);
  EXPECT_LT(report.energy_after, 1e-12 * report.energy_before);
}

TEST_P(StrategyTest, SolvesAQuadraticInOneStep) {
  for (const auto kind : {LinearSolverKind::kCholmod, LinearSolverKind::kUmfpack}) {
    Chain problem(100, 0.0);
    problem.set_minimum(problem.wave(1.0));
    Vector x = Vector::Zero(problem.size());
    Minimizer minimizer(kind);
    const Report report = minimizer.minimize(problem, x, with(GetParam()));
    EXPECT_EQ(report.iterations, 1) << report.message;
    EXPECT_EQ(report.evaluations, 2);
    EXPECT_EQ(report.solves, 1);
    EXPECT_TRUE(report.converged());
    EXPECT_EQ(report.linear_solver, kind);
  }
}

TEST_P(StrategyTest, TheIterationLimitIsAValue) {
  Rosenbrock problem(5);
  Vector x = problem.start();
  Minimizer minimizer;
  const Report report = minimizer.minimize(problem, x, with(GetParam(), 1e-12, 2));
  EXPECT_EQ(report.termination, Termination::kIterationLimit);
  EXPECT_FALSE(report.converged());
  EXPECT_EQ(report.iterations, 2);
  EXPECT_LT(report.energy_after, report.energy_before);
  EXPECT_EQ(report.energy_after, problem.evaluate(x, nullptr));
  EXPECT_NE(report.message.find("limit of 2 steps"), std::string::npos) << report.message;
}

TEST_P(StrategyTest, AnOptimalStartKeepsItsBits) {
  Chain problem(50, 0.05);
  const Vector minimum = problem.wave(1.0);
  problem.set_minimum(minimum);
  Minimizer minimizer;
  for (const double rounding : {0.0, 1e-17}) {
    Vector x = minimum * (1.0 + rounding);
    const Report report = minimizer.minimize(problem, x, with(GetParam()));
    EXPECT_EQ(report.termination, Termination::kAlreadyOptimal) << report.message;
    EXPECT_TRUE(x == minimum * (1.0 + rounding));
    EXPECT_EQ(report.factorizations, 0);
  }
}

// The second solve starts where rounding ended the first: it must see that, and not wander.
TEST_P(StrategyTest, StopsWhereRoundingDoes) {
  Chain problem(50, 0.05);
  problem.set_minimum(problem.wave(1.0));
  Vector x = problem.wave(0.9);
  Minimizer minimizer;
  const Report first = minimizer.minimize(problem, x, with(GetParam(), 0.0, 1000));
  EXPECT_TRUE(first.converged()) << first.message;
  const Vector found = x;
  const Report second = minimizer.minimize(problem, x, with(GetParam(), 0.0, 1000));
  EXPECT_EQ(second.termination, Termination::kAlreadyOptimal) << second.message;
  EXPECT_TRUE(x == found);
}

TEST_P(StrategyTest, CancellingLeavesTheUnknownsAlone) {
  Rosenbrock problem(5);
  const Vector start = problem.start();
  Vector x = start;
  Progress progress;
  progress.cancel();
  Minimizer minimizer;
  const Report report = minimizer.minimize(problem, x, with(GetParam()), &progress);
  EXPECT_EQ(report.termination, Termination::kCancelled);
  EXPECT_TRUE(x == start);
  EXPECT_EQ(report.factorizations, 0);
  EXPECT_EQ(report.energy_after, report.energy_before);
}

// Cancels itself after a number of evaluations, as an impatient artist would.
class CancelledLater final : public Problem {
 public:
  CancelledLater(Problem& problem, Progress& progress, int after)
      : problem_(problem), progress_(progress), left_(after) {}
  int size() const override { return problem_.size(); }
  double evaluate(const Vector& x, Vector* gradient) override {
    if (--left_ == 0) progress_.cancel();
    return problem_.evaluate(x, gradient);
  }
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override { return problem_.hessian(x, model); }

 private:
  Problem& problem_;
  Progress& progress_;
  int left_;
};

TEST_P(StrategyTest, CancellingInTheMiddleRestoresTheStart) {
  Rosenbrock rosenbrock(5);
  Progress progress;
  CancelledLater problem(rosenbrock, progress, 4);
  const Vector start = rosenbrock.start();
  Vector x = start;
  Minimizer minimizer;
  const Report report = minimizer.minimize(problem, x, with(GetParam()), &progress);
  EXPECT_EQ(report.termination, Termination::kCancelled);
  EXPECT_GT(report.iterations, 0);
  EXPECT_TRUE(x == start);
}

TEST(MinimizerTest, RefusesAStartOfTheWrongLengthOrNotFinite) {
  Rosenbrock problem(5);
  Minimizer minimizer;
  Vector short_start = Vector::Zero(9);
  EXPECT_THROW(minimizer.minimize(problem, short_start), InvalidInput);
  Vector infinite = problem.start();
  infinite[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(minimizer.minimize(problem, infinite), InvalidInput);
}

TEST(MinimizerTest, ReportsProgressUpToTheEnd) {
  Rosenbrock problem(5);
  Vector x = problem.start();
  Progress progress;
  Minimizer minimizer;
  minimizer.minimize(problem, x, {}, &progress);
  EXPECT_GT(progress.fraction(), 0.0);
  EXPECT_LE(progress.fraction(), 1.0);
  EXPECT_STREQ(progress.stage(), "iterating");
}

}  // namespace
}  // namespace reflines
