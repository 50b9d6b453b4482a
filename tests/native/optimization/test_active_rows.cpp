// Minima within limits of linear functions: those of a box, of one function with a known minimum, and both methods.
#include <gtest/gtest.h>

#include <cmath>

#include "least_squares.h"
#include "optimization/contact_quadratic.h"
#include "optimization/interior_point.h"
#include "optimization/minimizer.h"
#include "optimization/row_limits.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

SparseMatrix identity(int n) {
  SparseMatrix result(n, n);
  result.setIdentity();
  return result;
}

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

MinimizerOptions precise() {
  MinimizerOptions options;
  options.gradient_tolerance = 1e-8;
  options.max_iterations = 1000;
  return options;
}

TEST(RowLimits, OfSingleUnknownsAreBounds) {
  for (const double limit : {0.02, 0.1, 0.3, 0.6}) {
    Chain chain(30, 0.05);
    chain.set_minimum(chain.wave(1.0));
    const Vector start = Vector::Zero(30), ends = Vector::Constant(30, limit);
    const SparseMatrix modes = identity(30);
    Vector x = start, y = start;
    const Report report = Minimizer().minimize(chain, RowLimits(modes, -ends, ends, start, 1e-16), x, precise());
    ASSERT_TRUE(report.converged()) << report.message;
    ASSERT_TRUE(Minimizer().minimize(chain, Bounds{-ends, ends}, y, precise()).converged());
    EXPECT_LT((x - y).cwiseAbs().maxCoeff(), 1e-6 * limit);
    EXPECT_LE(x.cwiseAbs().maxCoeff(), limit);
    EXPECT_GE(x.cwiseAbs().maxCoeff(), (1 - 1e-6) * limit);
  }
}

TEST(RowLimits, BothMethodsSolveTheModel) {
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
  Report counts;
  ContactQuadratic contact(limits, factor, solver, counts, nullptr);
  const auto minimum = contact.minimize(gradient, limits.low, limits.high, limits.tolerance, {});
  ASSERT_TRUE(minimum);
  const Vector& d = minimum->d;
  EXPECT_GT(minimum->contacts.size(), 1U);
  const QuadraticModel quadratic{model, gradient};
  const StepLimits range{&limits.rows, limits.low, limits.high, limits.held};
  const Vector inside = InteriorPoint(quadratic, range, 1.0, factor, counts, nullptr)
                            .minimize(limits.tolerance, 1e-9 * gradient.norm())
                            .d;
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
