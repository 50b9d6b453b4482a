// Minima within bounds: known ones, a dense referee's, and the conditions that make one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "least_squares.h"
#include "optimization/minimizer.h"

namespace reflines {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Strategy kStrategies[] = {Strategy::kAdaptive, Strategy::kLinearized, Strategy::kGaussNewton,
                                    Strategy::kNewton};

MinimizerOptions with(Strategy strategy, double gradient_tolerance = 1e-9) {
  MinimizerOptions options;
  options.strategy = strategy;
  options.gradient_tolerance = gradient_tolerance;
  options.max_iterations = 1000;
  return options;
}

Bounds around(const Vector& x, double limit) { return {x.array() - limit, x.array() + limit}; }

// A quadratic energy's minimum within bounds, an unknown after the other until nothing moves any more.
Vector by_projected_gauss_seidel(Problem& problem, const Bounds& bounds, const Vector& start) {
  const Eigen::MatrixXd lower = problem.hessian(start, HessianModel::kGaussNewton);
  const Eigen::MatrixXd H = lower.selfadjointView<Eigen::Lower>();
  Vector x = bounds.nearest(start), gradient(x.size());
  problem.evaluate(x, &gradient);
  for (int sweep = 0; sweep < 200000; ++sweep) {
    double largest = 0.0;
    for (int k = 0; k < x.size(); ++k) {
      const double wanted = std::clamp(x(k) - gradient(k) / H(k, k), bounds.low(k), bounds.high(k));
      const double step = wanted - x(k);
      x(k) = wanted;
      gradient += step * H.col(k);
      largest = std::max(largest, std::abs(step));
    }
    if (largest < 1e-15) break;
  }
  return x;
}

void expect_minimum(Problem& problem, const Bounds& bounds, const Vector& x, double small) {
  Vector gradient(x.size());
  problem.evaluate(x, &gradient);
  EXPECT_LE(bounds.projected_norm(x, gradient), small);
  EXPECT_TRUE(bounds.nearest(x) == x);
}

class BoundedStrategyTest : public testing::TestWithParam<Strategy> {};

INSTANTIATE_TEST_SUITE_P(Strategies, BoundedStrategyTest, testing::ValuesIn(kStrategies),
                         [](const auto& info) { return std::string(to_string(info.param)); });

TEST_P(BoundedStrategyTest, AgreesWithADenseReferee) {
  for (const double limit : {0.02, 0.1, 0.3, 0.6}) {
    Chain chain(30, 0.0);
    chain.set_minimum(chain.wave(1.0));
    const Vector start = Vector::Zero(30);
    const Bounds bounds = around(start, limit);
    Vector x = start;
    Minimizer minimizer;
    const Report report = minimizer.minimize(chain, bounds, x, with(GetParam()));
    ASSERT_TRUE(report.converged()) << report.message;
    EXPECT_LT((x - by_projected_gauss_seidel(chain, bounds, start)).cwiseAbs().maxCoeff(), 1e-6 * limit);
    EXPECT_GT(count_held(bounds.touched_by(x)), 0);
    expect_minimum(chain, bounds, x, 1e-9 * report.gradient_before);
  }
}

TEST_P(BoundedStrategyTest, StopsAtAMinimumOfABentChain) {
  Chain chain(60, 0.05);
  chain.set_minimum(chain.wave(1.0));
  const Vector start = chain.wave(0.3);
  const Bounds bounds = around(start, 0.2);
  Vector x = start;
  Minimizer minimizer;
  const Report report = minimizer.minimize(chain, bounds, x, with(GetParam(), 1e-8));
  ASSERT_TRUE(report.converged()) << report.message;
  expect_minimum(chain, bounds, x, 1e-8 * report.gradient_before);
  EXPECT_LT(report.energy_after, report.energy_before);
}

// The steps to the free minimum, with which it begins, count as well: it took up to twice the limit.
TEST_P(BoundedStrategyTest, TakesNoMoreStepsThanAllowed) {
  for (const int most : {0, 1, 2, 3, 5, 8, 13}) {
    Chain chain(60, 0.05);
    chain.set_minimum(chain.wave(1.0));
    Vector free = chain.wave(0.3), x = free;
    MinimizerOptions options = with(GetParam(), 1e-8);
    options.max_iterations = most;
    const int before = Minimizer().minimize(chain, free, options).iterations;
    const Report report = Minimizer().minimize(chain, around(x, 0.2), x, options);
    EXPECT_GE(report.iterations, before);
    EXPECT_LE(report.iterations, most);
    EXPECT_TRUE(report.converged() || report.iterations == most) << most << ": " << report.message;
  }
}

// Second differences of the bent beam are linear between the ends and the obstacle, so that its heights are a cubic.
TEST(ActiveBoundsTest, ABeamOverAnObstacleIsACubic) {
  constexpr int kMiddle = 20, kSize = 2 * kMiddle - 1;
  Chain beam(kSize, 0.0);
  Bounds bounds{Vector::Constant(kSize, -kInfinity), Vector::Constant(kSize, kInfinity)};
  bounds.low(kMiddle - 1) = 1.0;
  Vector x = Vector::Zero(kSize);
  Minimizer minimizer;
  const Report report = minimizer.minimize(beam, bounds, x, with(Strategy::kAdaptive));
  ASSERT_TRUE(report.converged()) << report.message;
  EXPECT_EQ(report.put_back, 1);
  EXPECT_EQ(x(kMiddle - 1), 1.0);
  const double m = kMiddle, bend = 6.0 / (2 * m * m * m + m);
  for (int k = 0; k < kSize; ++k) {
    const double s = m - std::abs(k + 1 - m);
    EXPECT_NEAR(x(k), bend * (m * m / 2 * s - s * (s * s - 1) / 6), 1e-9);
  }
}

TEST(ActiveBoundsTest, UnboundedSolvesAfterwardsAreNotMisled) {
  Chain chain(60, 0.05);
  const Vector minimum = chain.wave(1.0);
  chain.set_minimum(minimum);
  Minimizer minimizer;
  Vector x = Vector::Zero(60);
  ASSERT_TRUE(minimizer.minimize(chain, around(x, 0.1), x).converged());
  ASSERT_TRUE(minimizer.minimize(chain, x, with(Strategy::kAdaptive)).converged());
  EXPECT_LT((x - minimum).norm(), 1e-6);
}

// Of a wave only the highest places touch: the free factor serves for all of them. With the primal-dual active set
// alone these took 15, 410, 35 and 397 factorizations, and two of them did not converge.
TEST(ActiveBoundsTest, FewContactsCostNoFactorizations) {
  constexpr int kSize = 400;
  Chain chain(kSize, 0.0);
  Vector wanted(kSize);
  for (int k = 0; k < kSize; ++k) wanted(k) = std::sin(0.1 * k) * (1.0 + 0.002 * k);
  chain.set_minimum(wanted);
  for (const double limit : {1.2, 1.4, 1.6, 1.7}) {
    const Bounds bounds = around(Vector::Zero(kSize), limit);
    Vector x = Vector::Zero(kSize);
    Minimizer minimizer;
    const Report report = minimizer.minimize(chain, bounds, x, with(Strategy::kAdaptive));
    ASSERT_TRUE(report.converged()) << limit << ": " << report.message;
    expect_minimum(chain, bounds, x, 1e-9 * report.gradient_before);
    EXPECT_GT(count_held(bounds.touched_by(x)), 2);
    EXPECT_LE(report.factorizations, 3);  // the free minimum's, that of the model, and one for the last digits
  }
}

// A beam nearly straight lies on a bound along whole stretches: the active set alone would shrink unknown by unknown.
TEST(ActiveBoundsTest, TheSetSettlesInFewFactorizationsWhateverTheNumberOfUnknowns) {
  int factorizations[2];
  for (int k = 0; k < 2; ++k) {
    const int size = k == 0 ? 200 : 3200;
    Chain chain(size, 0.0);
    chain.set_minimum(chain.wave(1.0));
    const Bounds bounds = around(Vector::Zero(size), 0.3);
    Vector x = Vector::Zero(size);
    Minimizer minimizer;
    const Report report = minimizer.minimize(chain, bounds, x, with(Strategy::kAdaptive, 1e-6));
    EXPECT_TRUE(report.converged()) << report.message;
    factorizations[k] = report.factorizations;
  }
  EXPECT_LT(factorizations[1], 2 * factorizations[0] + 10);
}

}  // namespace
}  // namespace reflines
