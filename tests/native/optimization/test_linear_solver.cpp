// Both back ends solve what dense algebra solves, and say so where nothing can be solved.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <future>
#include <random>
#include <set>
#include <vector>

#include "optimization/linear/linear_solver.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

class LinearSolverTest : public testing::TestWithParam<LinearSolverKind> {};

INSTANTIATE_TEST_SUITE_P(Backends, LinearSolverTest,
                         testing::Values(LinearSolverKind::kCholmod, LinearSolverKind::kUmfpack),
                         [](const auto& info) { return std::string(to_string(info.param)); });

Eigen::MatrixXd random_symmetric(int n, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Eigen::MatrixXd factor = Eigen::MatrixXd::NullaryExpr(n, columns, [&]() { return uniform(random); });
  Eigen::MatrixXd banded = factor * factor.transpose();
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (std::abs(i - j) > 4) banded(i, j) = 0.0;
    }
  }
  return banded + Eigen::MatrixXd::Identity(n, n) * n;
}

SparseMatrix lower_of(const Eigen::MatrixXd& dense) {
  SparseMatrix lower = dense.triangularView<Eigen::Lower>().toDenseMatrix().sparseView();
  lower.makeCompressed();
  return lower;
}

TEST_P(LinearSolverTest, AgreesWithDenseCholesky) {
  const Eigen::MatrixXd dense = random_symmetric(60, 60, 1);
  LinearSolver solver(GetParam());
  solver.analyze(lower_of(dense));
  solver.factorize(lower_of(dense));
  Vector x = Vector::LinSpaced(60, -1.0, 2.0);
  const Vector expected = dense.llt().solve(x);
  solver.solve(x);
  EXPECT_EQ(solver.diagonal_shift(), 0.0);
  EXPECT_LT((x - expected).norm(), 1e-13 * expected.norm());
}

// Scaling unknowns by nine orders of magnitude changes the ratio of pivots, not the digits of the solution.
TEST_P(LinearSolverTest, UnknownsOfVeryDifferentScaleAreNoSingularity) {
  const Vector scale = Eigen::pow(10.0, Vector::LinSpaced(60, -4.5, 4.5).array());
  const Eigen::MatrixXd dense = random_symmetric(60, 60, 1);
  const SparseMatrix scaled = lower_of(scale.asDiagonal() * dense * scale.asDiagonal());
  LinearSolver solver(GetParam());
  solver.analyze(scaled);
  solver.factorize(scaled);
  EXPECT_EQ(solver.diagonal_shift(), 0.0);
  Vector x = scale;
  solver.solve(x);
  EXPECT_LT((x.cwiseProduct(scale) - dense.llt().solve(Vector::Ones(60))).norm(), 1e-12);
}

// A height in no residual has an empty row: it stays, and the others do not notice.
TEST_P(LinearSolverTest, UnknownsThatNothingAsksForStay) {
  Eigen::MatrixXd dense = random_symmetric(20, 20, 3);
  Vector expected = dense.topLeftCorner(15, 15).llt().solve(Vector::Ones(15));
  dense.bottomRows(5).setZero();
  dense.rightCols(5).setZero();
  SparseMatrix lower = lower_of(dense);
  for (int k = 15; k < 20; ++k) lower.coeffRef(k, k) = 0.0;
  lower.makeCompressed();
  LinearSolver solver(GetParam());
  solver.analyze(lower);
  solver.factorize(lower);
  Vector x = Vector::Ones(20);
  x.tail(5).setZero();
  solver.solve(x);
  EXPECT_LT((x.head(15) - expected).norm(), 1e-10 * expected.norm());
  EXPECT_EQ(x.tail(5).norm(), 0.0);
}

TEST_P(LinearSolverTest, OneAnalysisServesAllValuesOfAPattern) {
  LinearSolver solver(GetParam());
  solver.analyze(lower_of(random_symmetric(40, 40, 1)));
  for (unsigned seed = 2; seed < 5; ++seed) {
    const Eigen::MatrixXd dense = random_symmetric(40, 40, seed);
    ASSERT_TRUE(solver.has_pattern_of(lower_of(dense)));
    solver.factorize(lower_of(dense));
    Vector x = Vector::Ones(40);
    solver.solve(x);
    EXPECT_LT((dense * x - Vector::Ones(40)).norm(), 1e-12);
  }
  EXPECT_FALSE(solver.has_pattern_of(lower_of(random_symmetric(41, 41, 1))));
  EXPECT_FALSE(solver.has_pattern_of(lower_of(Eigen::MatrixXd::Identity(40, 40))));
}

// The Laplacian of a free chain is semi-definite: constants are its null space. The shift must leave a right side
// without a constant part solved as by the pseudo-inverse.
TEST_P(LinearSolverTest, ShiftsTheDiagonalOfASemiDefiniteMatrix) {
  const int n = 50;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k + 1 < n; ++k) dense.block<2, 2>(k, k) += Eigen::Matrix2d{{1.0, -1.0}, {-1.0, 1.0}};
  LinearSolver solver(GetParam());
  solver.analyze(lower_of(dense));
  solver.factorize(lower_of(dense));
  EXPECT_GT(solver.diagonal_shift(), 0.0);
  Vector right_side = Vector::Zero(n);
  right_side[0] = 1.0;
  right_side[n - 1] = -1.0;
  Vector x = right_side;
  solver.solve(x);
  EXPECT_LT((dense * x - right_side).norm(), 1e-5);
}

TEST_P(LinearSolverTest, NearlySingularIsStillSolved) {
  Eigen::MatrixXd dense = random_symmetric(30, 30, 7);
  dense.row(3) *= 1e-6;
  dense.col(3) *= 1e-6;
  LinearSolver solver(GetParam());
  solver.analyze(lower_of(dense));
  solver.factorize(lower_of(dense));
  EXPECT_EQ(solver.diagonal_shift(), 0.0);
  Vector x = dense * Vector::Ones(30);
  solver.solve(x);
  EXPECT_LT((x - Vector::Ones(30)).norm(), 1e-9);
}

TEST_P(LinearSolverTest, IndefiniteOrZeroIsAFailureInWords) {
  Eigen::MatrixXd indefinite = random_symmetric(20, 20, 3);
  indefinite.row(5).setZero();
  indefinite.col(5).setZero();
  indefinite(5, 5) = -1.0;
  for (const double scale : {1.0, 0.0}) {
    SparseMatrix lower = lower_of(indefinite);
    lower *= scale;
    LinearSolver solver(GetParam());
    solver.analyze(lower);
    EXPECT_THROW(solver.factorize(lower), SolverFailure);
    EXPECT_FALSE(solver.has_factor());
  }
}

// A system large enough to be abandoned: some tenths of a second.
SparseMatrix thick_chain(int n, int reach) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < n; ++column) {
    for (int row = column; row < std::min(n, column + reach); ++row)
      entries.emplace_back(row, column, row == column ? 2.0 * reach : -1.0 / (1 + row - column));
  }
  SparseMatrix lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

Vector solve_ones(LinearSolver& solver, const SparseMatrix& matrix, const Progress* progress) {
  if (!solver.has_pattern_of(matrix)) solver.analyze(matrix, {}, progress);
  solver.factorize(matrix, progress);
  Vector x = Vector::Ones(matrix.rows());
  solver.solve(x);
  return x;
}

TEST_P(LinearSolverTest, ACancelledFactorizationIsLeftBehindAndTheNextHasTheSameBits) {
  const SparseMatrix matrix = thick_chain(30000, 40);
  LinearSolver solver(GetParam()), other(GetParam());
  const Vector expected = solve_ones(other, matrix, nullptr);
  Progress cancelled, watched;
  solver.analyze(matrix);
  cancelled.cancel();
  EXPECT_THROW(solver.factorize(matrix, &cancelled), Cancelled);
  EXPECT_FALSE(solver.has_factor());
  EXPECT_FALSE(solver.has_pattern_of(matrix));
  EXPECT_EQ(solve_ones(solver, matrix, &watched), expected);
}

// Of a 40 x 40 grid, whose factor has fronts of many sizes: with L^-1 P = M the inverse is M^T M.
SparseMatrix grid_laplacian(int side) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < side * side; ++k) {
    entries.emplace_back(k, k, 4.5);
    if ((k + 1) % side != 0) entries.emplace_back(k + 1, k, -1.0);
    if (k + side < side * side) entries.emplace_back(k + side, k, -1.0);
  }
  SparseMatrix lower(side * side, side * side);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

// METIS draws from `rand`, of which a process has one: without the lock nearly all of these solutions had other bits.
TEST_P(LinearSolverTest, SystemsOrderedAtOnceKeepTheirBits) {
  const SparseMatrix matrix = grid_laplacian(40);
  const auto solve = [&matrix, kind = GetParam()] {
    LinearSolver solver(kind);
    return solve_ones(solver, matrix, nullptr);
  };
  const Vector alone = solve();
  const auto count_others = [&] {
    int others = 0;
    for (int k = 0; k < 100; ++k) others += solve() != alone;
    return others;
  };
  std::vector<std::future<int>> counts;
  for (int k = 0; k < 4; ++k) counts.push_back(std::async(std::launch::async, count_others));
  for (std::future<int>& count : counts) EXPECT_EQ(count.get(), 0);
}

TEST(LinearSolverHalves, MakeTheSolveAndTheInverse) {
  const int side = 40, n = side * side;
  const SparseMatrix matrix = grid_laplacian(side);
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(matrix);
  solver.factorize(matrix);
  Eigen::MatrixXd whole = Vector::LinSpaced(n, -1.0, 2.0);
  Vector halves = whole;
  solver.solve(whole);
  solver.solve_lower(halves);
  solver.solve_upper(halves);
  EXPECT_LT((halves - whole).norm(), 1e-14 * whole.norm());
}

// The referees are solves of the whole system.
TEST(LinearSolverHalves, SolveForSparseColumnsAlongPathsOfTheTree) {
  const int side = 40, n = side * side;
  const SparseMatrix matrix = grid_laplacian(side);
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(matrix);
  solver.factorize(matrix);
  SparseMatrix B(n, 11);
  const int rows[] = {0, 7, 8, 47, 48, 49, 90, 800, n - 1};
  for (int j = 0; j < 9; ++j) B.insert(rows[j], j) = 1.0;
  for (const int row : {300, 301, 340}) B.insert(row, 9) = 0.1 * row;
  B.insert(20, 10) = -2.0;
  Eigen::MatrixXd inverse = B;
  solver.solve(inverse);

  const std::vector<SparseColumns> blocks = solver.solve_lower(B);
  std::vector<Vector> halves;
  for (const SparseColumns& block : blocks) {
    EXPECT_LT(block.row.size(), n / 2);  // paths, not the tree
    for (int j = 0; j < block.count; ++j) {
      halves.push_back(Vector::Zero(n));
      block.subtract_product(-Vector::Unit(block.count, j), halves.back());
    }
  }
  ASSERT_EQ(halves.size(), 11);
  for (int j = 0; j < 11; ++j) {
    Vector lower = B.col(j);
    solver.solve_lower(lower);
    EXPECT_LT((halves[j] - lower).norm(), 1e-14 * lower.norm());
  }
  Eigen::Index first = 0;
  for (const SparseColumns& block : blocks) {
    SparseColumns::Rows other = SparseColumns::Rows::Zero(n, SparseColumns::kWidth);
    other(block.row, Eigen::all) = block.value;
    const Eigen::MatrixXd products = blocks[0].transposed_times(other).leftCols(block.count);
    const Eigen::MatrixXd expected = (B.transpose() * inverse).block(0, first, SparseColumns::kWidth, block.count);
    EXPECT_LT((products - expected).norm(), 1e-13 * inverse.norm());
    first += block.count;
  }
}

TEST(LinearSolverHalves, SortUnknownsByElimination) {
  const SparseMatrix matrix = grid_laplacian(3);
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(matrix, {8, 1, 6, 3, 0, 5, 2, 7, 4});
  solver.factorize(matrix);
  const std::vector<int> sorted = solver.sort_by_elimination({4, 0, 1, 8});
  EXPECT_EQ(std::set<int>(sorted.begin(), sorted.end()), (std::set<int>{0, 1, 4, 8}));
  EXPECT_EQ(sorted.back(), 4);  // the root stays last, whatever the order within the tree
}

}  // namespace
}  // namespace reflines
