// Unknowns held and released by the Schur complement of a bordered system, and by a factor made for them, give the same
// solutions.
#include <gtest/gtest.h>

#include "least_squares.h"
#include "optimization/held_factor.h"

namespace reflines {
namespace {

constexpr int kSize = 200;

struct HeldFactorTest : testing::TestWithParam<LinearSolverKind> {
  HeldFactorTest() : chain(kSize, 0.0), H(chain.hessian(Vector::Zero(kSize), HessianModel::kGaussNewton)) {
    solver.analyze(H);
  }

  Vector solve(HeldFactor& factor) const {
    Vector x = Vector::LinSpaced(kSize, -1.0, 2.0);
    factor.solve(x);
    return x;
  }

  Vector solve_anew(const Sides& held) {
    LinearSolver other(LinearSolverKind::kCholmod);
    other.analyze(H);
    HeldFactor factor(other);
    factor.factorize(H, held, nullptr);
    return solve(factor);
  }

  Sides hold(std::initializer_list<int> unknowns) const {
    Sides held(kSize, Side::kBetween);
    for (const int k : unknowns) held[k] = Side::kHigh;
    return held;
  }

  Chain chain;
  SparseMatrix H;
  LinearSolver solver{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Backends, HeldFactorTest,
                         testing::Values(LinearSolverKind::kCholmod, LinearSolverKind::kUmfpack),
                         [](const auto& info) { return std::string(to_string(info.param)); });

TEST_P(HeldFactorTest, ContactsAreHeldAsByAFactorWithoutThem) {
  HeldFactor factor(solver);
  factor.factorize(H, hold({7}), nullptr);
  for (const Sides& held : {hold({7}), hold({7, 50}), hold({3, 7, 50, 51, 120}), hold({7, 120}), hold({7})}) {
    ASSERT_TRUE(factor.hold(H, held, nullptr));
    const Vector x = solve(factor), expected = solve_anew(held);
    EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm());
    for (int k = 0; k < kSize; ++k) {
      if (held[k] != Side::kBetween) EXPECT_EQ(x(k), 0.0);
    }
  }
}

// The referee writes the values into the right-hand side of a factor that leaves the contacts out.
TEST_P(HeldFactorTest, ContactsAreHeldWhereTheyAreAskedFor) {
  HeldFactor factor(solver);
  const Sides held = hold({7, 50, 51, 120});
  factor.factorize(H, hold({7}), nullptr);
  ASSERT_TRUE(factor.hold(H, held, nullptr));
  for (const double value : {0.5, -2.0}) {  // the second meets the same right-hand side
    Vector at = Vector::Constant(kSize, value);
    Vector x = Vector::LinSpaced(kSize, -1.0, 2.0);
    factor.solve(x, at);
    at(7) = 0.0;
    for (int k = 0; k < kSize; ++k) at(k) = held[k] == Side::kBetween ? 0.0 : at(k);
    LinearSolver other(LinearSolverKind::kCholmod);
    other.analyze(H);
    HeldFactor anew(other);
    anew.factorize(H, held, nullptr);
    Vector expected = Vector::LinSpaced(kSize, -1.0, 2.0) - H.selfadjointView<Eigen::Lower>() * at;
    anew.solve(expected);
    expected += at;
    EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm());
    EXPECT_EQ(x(50), value);
    EXPECT_EQ(x(7), 0.0);
  }
}

TEST_P(HeldFactorTest, ForcesAreWhatTheHeldSolutionLeavesOfTheRightSide) {
  HeldFactor factor(solver);
  factor.factorize(H, hold({7, 90}), nullptr);
  ASSERT_TRUE(factor.hold(H, hold({7, 50, 51, 120}), nullptr));  // 90 is released
  EXPECT_EQ(factor.contacts(), (std::vector<int>{50, 51, 120}));
  const Vector right = Vector::LinSpaced(kSize, -1.0, 2.0), at = Vector::Constant(kSize, 0.5);
  const Vector forces = factor.find_forces(right, at);
  Vector x = right;
  factor.solve(x, at);
  const Vector left = right - H.selfadjointView<Eigen::Lower>() * x;
  EXPECT_LT((forces - left(factor.contacts())).norm(), 1e-9 * forces.norm());
}

TEST_P(HeldFactorTest, ReleasedUnknownsMoveAsByAFactorWithThem) {
  HeldFactor factor(solver);
  factor.factorize(H, hold({7, 50, 51, 120}), nullptr);
  for (const Sides& held : {hold({7, 50, 51}), hold({51}), hold({3, 7, 49, 120}), hold({7, 50, 51, 120}), hold({52})}) {
    ASSERT_TRUE(factor.hold(H, held, nullptr));
    const Vector x = solve(factor), expected = solve_anew(held);
    EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm());
    for (int k = 0; k < kSize; ++k) EXPECT_EQ(x(k) == 0.0, held[k] != Side::kBetween);
  }
  EXPECT_FALSE(factor.leaves_out(hold({7, 50, 51, 120})));
  ASSERT_TRUE(factor.hold(H, hold({7, 50, 51, 120}), nullptr));
  EXPECT_TRUE(factor.leaves_out(hold({7, 50, 51, 120})));
}

TEST_P(HeldFactorTest, ContactsCostNoSolveWithHalvesAndElseOneTheFirstTime) {
  HeldFactor factor(solver);
  factor.factorize(H, hold({}), nullptr);
  const int one = solver.has_halves() ? 0 : 1;
  EXPECT_EQ(factor.hold(H, hold({10, 20}), nullptr), 2 * one);
  EXPECT_EQ(factor.hold(H, hold({20, 30}), nullptr), one);
  EXPECT_EQ(factor.hold(H, hold({10, 20, 30}), nullptr), 0);
  Vector x = Vector::Ones(kSize);
  EXPECT_EQ(factor.solve(x), 1 + one);
}

TEST_P(HeldFactorTest, ACancelledContactLeavesTheOthers) {
  HeldFactor factor(solver);
  factor.factorize(H, hold({}), nullptr);
  ASSERT_TRUE(factor.hold(H, hold({10}), nullptr));
  const Vector before = solve(factor);
  Progress progress;
  progress.cancel();
  EXPECT_THROW(factor.hold(H, hold({10, 20, 30}), &progress), Cancelled);
  EXPECT_EQ(solve(factor), before);
  EXPECT_EQ(factor.hold(H, hold({10, 20}), nullptr), solver.has_halves() ? 0 : 1);
}

TEST_P(HeldFactorTest, AsksForAnotherFactorWhereThisOneCannotHold) {
  HeldFactor factor(solver);
  EXPECT_FALSE(factor.hold(H, hold({}), nullptr));  // there is none
  factor.factorize(H, hold({7}), nullptr);
  Sides many = hold({7});
  std::fill_n(many.begin() + 8, HeldFactor::kMostNewColumns + 1, Side::kLow);
  EXPECT_FALSE(factor.hold(H, many, nullptr));
  EXPECT_TRUE(factor.hold(H, hold({7, 8}), nullptr));
  factor.forget();
  EXPECT_FALSE(factor.hold(H, hold({7, 8}), nullptr));
}

}  // namespace
}  // namespace reflines
