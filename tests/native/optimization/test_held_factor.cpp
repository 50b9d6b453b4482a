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

TEST_P(HeldFactorTest, ReleasedUnknownsMoveAsByAFactorWithThem) {
  HeldFactor factor(solver);
  factor.factorize(H, hold({7, 50, 51, 120}), nullptr);
  for (const Sides& held : {hold({7, 50, 51}), hold({51}), hold({3, 7, 49, 120}), hold({7, 50, 51, 120}), hold({52})}) {
    ASSERT_TRUE(factor.hold(H, held, nullptr));
    const Vector x = solve(factor), expected = solve_anew(held);
    EXPECT_LT((x - expected).norm(), 1e-9 * expected.norm());
    for (int k = 0; k < kSize; ++k) EXPECT_EQ(x(k) == 0.0, held[k] != Side::kBetween);
  }
  EXPECT_TRUE(factor.leaves_out(hold({7, 50, 51, 120})));
  for (const Sides& other : {hold({52}), hold({7, 50, 51})}) EXPECT_FALSE(factor.leaves_out(other));
}

TEST_P(HeldFactorTest, ContactsCostNoSolveWithHalvesAndElseOneTheFirstTime) {
  HeldFactor factor(solver);
  factor.factorize(H, hold({}), nullptr);
  const int one = solver.has_halves() ? 0 : 1;
  ASSERT_TRUE(factor.hold(H, hold({10, 20}), nullptr));
  EXPECT_EQ(factor.solves(), 2 * one);
  ASSERT_TRUE(factor.hold(H, hold({20, 30}), nullptr));
  ASSERT_TRUE(factor.hold(H, hold({10, 20, 30}), nullptr));
  EXPECT_EQ(factor.solves(), 3 * one);
  solve(factor);
  EXPECT_EQ(factor.solves(), 3 * one + 1 + one);
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
  const int before_next = factor.solves();
  ASSERT_TRUE(factor.hold(H, hold({10, 20}), nullptr));
  EXPECT_EQ(factor.solves() - before_next, solver.has_halves() ? 0 : 1);
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
