// Minima within bounds and within limits of linear functions: known ones, a dense referee's, the conditions that make
// one, and the methods that find them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "least_squares.h"
#include "optimization/contact_quadratic.h"
#include "optimization/interior_point.h"
#include "optimization/minimizer.h"
#include "optimization/row_limits.h"
#include "reflines/errors.h"

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

// The means of neighbours, each an unknown and half of the next two.
SparseMatrix means(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i + 2 < n; ++i) {
    entries.emplace_back(i, i, 0.25);
    entries.emplace_back(i + 1, i, 0.5);
    entries.emplace_back(i + 2, i, 0.25);
  }
  SparseMatrix result(n, n - 2);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

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

// Single unknowns as bounds, and as functions that each depend on one.
class LimitedStrategyTest : public testing::TestWithParam<std::tuple<Strategy, bool>> {
 protected:
  RowLimits limits(const Vector& start, double limit) {
    if (!std::get<bool>(GetParam())) return around(start, limit);
    modes_.resize(start.size(), start.size());
    modes_.setIdentity();
    const Vector ends = Vector::Constant(start.size(), limit);
    return {modes_, -ends, ends, start, 1e-16};
  }
  static MinimizerOptions options(double gradient_tolerance) {
    return with(std::get<Strategy>(GetParam()), gradient_tolerance);
  }

 private:
  SparseMatrix modes_;
};

std::string name_case(const testing::TestParamInfo<LimitedStrategyTest::ParamType>& info) {
  return std::string(to_string(std::get<Strategy>(info.param))) + (std::get<bool>(info.param) ? "OfRows" : "OfBounds");
}

INSTANTIATE_TEST_SUITE_P(Strategies, LimitedStrategyTest,
                         testing::Combine(testing::ValuesIn(kStrategies), testing::Bool()), name_case);

TEST_P(LimitedStrategyTest, AgreesWithADenseReferee) {
  for (const double limit : {0.02, 0.1, 0.3, 0.6}) {
    Chain chain(30, 0.0);
    chain.set_minimum(chain.wave(1.0));
    const Vector start = Vector::Zero(30);
    Vector x = start;
    const Report report = Minimizer().minimize(chain, limits(start, limit), x, options(1e-9));
    ASSERT_TRUE(report.converged()) << report.message;
    EXPECT_LT((x - by_projected_gauss_seidel(chain, around(start, limit), start)).cwiseAbs().maxCoeff(), 1e-6 * limit);
    EXPECT_LE(x.cwiseAbs().maxCoeff(), limit);
    EXPECT_GE(x.cwiseAbs().maxCoeff(), (1 - 1e-6) * limit);
  }
}

TEST_P(LimitedStrategyTest, StopsAtAMinimumOfABentChain) {
  Chain chain(60, 0.05);
  chain.set_minimum(chain.wave(1.0));
  const Vector start = chain.wave(0.3);
  const RowLimits within = limits(start, 0.2);
  Vector x = start;
  const Report report = Minimizer().minimize(chain, within, x, options(1e-8));
  ASSERT_TRUE(report.converged()) << report.message;
  if (within.are_bounds()) expect_minimum(chain, around(start, 0.2), x, 1e-8 * report.gradient_before);
  EXPECT_EQ(within.count_beyond(x), 0);
  EXPECT_LT(report.energy_after, report.energy_before);
}

// The steps to the free minimum, with which it begins, count as well: it took up to twice the limit.
TEST_P(LimitedStrategyTest, TakesNoMoreStepsThanAllowed) {
  for (const int most : {0, 1, 2, 3, 5, 8, 13}) {
    Chain chain(60, 0.05);
    chain.set_minimum(chain.wave(1.0));
    Vector free = chain.wave(0.3), x = free;
    MinimizerOptions few = options(1e-8);
    few.max_iterations = most;
    const int before = Minimizer().minimize(chain, free, few).iterations;
    const Report report = Minimizer().minimize(chain, limits(x, 0.2), x, few);
    EXPECT_GE(report.iterations, before);
    EXPECT_LE(report.iterations, most);
    EXPECT_TRUE(report.converged() || report.iterations == most) << most << ": " << report.message;
  }
}

// Second differences of the bent beam are linear between the ends and the obstacle, so that its heights are a cubic.
TEST(ActiveSetTest, ABeamOverAnObstacleIsACubic) {
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

TEST(ActiveSetTest, UnboundedSolvesAfterwardsAreNotMisled) {
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
TEST(ActiveSetTest, FewContactsCostNoFactorizations) {
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
TEST(ActiveSetTest, TheSetSettlesInFewFactorizationsWhateverTheNumberOfUnknowns) {
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

TEST(ActiveSetTest, BothMethodsSolveTheModel) {
  Chain chain(40, 0.0);
  chain.set_minimum(chain.wave(1.0));
  const Vector start = Vector::Zero(40);
  const SparseMatrix modes = means(40);
  const Vector ends = Vector::Constant(modes.cols(), 0.2);
  const RowLimits::Narrow limits = RowLimits(modes, -ends, ends, start, 1e-16).narrow(1.0);
  Vector gradient(40);
  chain.evaluate(start, &gradient);
  const SparseMatrix model = chain.hessian(start, HessianModel::kGaussNewton);
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(model);
  HeldFactor factor(solver);
  factor.factorize(model, limits.held, nullptr);
  const QuadraticModel quadratic{model, gradient};
  const ContactQuadratic::Minimum minimum =
      ContactQuadratic(limits, factor.border(), nullptr).minimize(quadratic, limits.range, 0.0, {});
  ASSERT_TRUE(minimum.complete);
  const Vector& d = minimum.d;
  EXPECT_GT(minimum.contacts.size(), 1U);
  const StepLimits range{&limits.rows, limits.range, limits.held};
  const Vector inside =
      minimize_from_inside(quadratic, range, 1.0, limits.tolerance, 1e-9 * gradient.norm(), factor, nullptr).d;
  EXPECT_LT((inside - d).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LE((modes.transpose() * d).cwiseAbs().maxCoeff(), 0.2);
  EXPECT_LE((modes.transpose() * inside).cwiseAbs().maxCoeff(), 0.2);
}

TEST(RowLimits, HoldWhatCanMoveNeitherWay) {
  const SparseMatrix modes = means(8);
  Vector low = Vector::Constant(6, -1.0), high = Vector::Constant(6, 1.0);
  low(0) = high(0) = 0.0;  // unknowns 0 to 2
  low(4) = 0.0;            // 4 to 6 only up
  high(5) = 0.0;           // 5 to 7 only down
  const RowLimits limits(modes, low, high, Vector::Zero(8), 1e-16);
  const RowLimits::Narrow narrow = limits.narrow(1.0);
  for (const int k : {0, 1, 2, 5, 6}) EXPECT_EQ(narrow.held[k], Side::kLow);
  for (const int k : {3, 4, 7}) EXPECT_EQ(narrow.held[k], Side::kBetween);
  EXPECT_TRUE(limits.contain(narrow.base));
  Vector beyond = Vector::Zero(8);
  beyond(4) = 5.0;
  const Vector back = narrow.pull_inside(narrow.base, beyond);
  EXPECT_TRUE(limits.contain(back));
  EXPECT_GT(back(4), 0.9);
}

TEST(RowLimits, RefuseNegativeWeights) {
  SparseMatrix modes = means(4);
  modes.coeffRef(0, 0) = -0.1;
  const Vector ends = Vector::Ones(2);
  EXPECT_THROW(RowLimits(modes, -ends, ends, Vector::Zero(4), 0.0), InvalidInput);
}

TEST(Complementarity, MeetsItsConditions) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(30, 30);
  const Eigen::MatrixXd S = A * A.transpose() + 0.01 * Eigen::MatrixXd::Identity(30, 30);
  const Vector c = Vector::Random(30);
  const Vector y = solve_complementarity(S, c, 1e-12).y;
  const Vector over = S * y - c;
  EXPECT_GE(y.minCoeff(), 0.0);
  EXPECT_GE(over.minCoeff(), -1e-8);
  EXPECT_LE(std::abs(y.dot(over)), 1e-8);
}

}  // namespace
}  // namespace reflines
