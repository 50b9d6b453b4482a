// The order by straight cuts: a permutation for any places, and for a plane grid one with little fill.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "optimization/linear/dissection.h"
#include "optimization/linear/linear_solver.h"

namespace reflines {
namespace {

constexpr int kSide = 80;

// Squares' corners, each coupled with the eight around it.
SparseMatrix grid_matrix() {
  std::vector<Eigen::Triplet<double>> entries;
  for (int a = 0; a < kSide * kSide; ++a) {
    entries.emplace_back(a, a, 9.0);
    for (const int step : {1, kSide - 1, kSide, kSide + 1}) {
      const int b = a + step, shift = b % kSide - a % kSide;
      if (b < kSide * kSide && std::abs(shift) <= 1) entries.emplace_back(b, a, -1.0);
    }
  }
  SparseMatrix lower(kSide * kSide, kSide * kSide);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

PlanePositions grid_places() {
  PlanePositions places(kSide * kSide, 2);
  for (int a = 0; a < places.rows(); ++a) places.row(a) << a % kSide, a / kSide;
  return places;
}

// Entries of L below the diagonal when the unknowns are eliminated in this order.
std::int64_t fill(const SparseMatrix& lower, const std::vector<int>& order) {
  std::vector<int> turn(order.size());
  for (size_t k = 0; k < order.size(); ++k) turn[order[k]] = static_cast<int>(k);
  std::vector<std::vector<int>> later(order.size());  // by turn
  for (int column = 0; column < lower.cols(); ++column) {
    for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
      const int a = turn[entry.row()], b = turn[column];
      if (a != b) later[std::min(a, b)].push_back(std::max(a, b));
    }
  }
  std::int64_t count = 0;
  for (std::vector<int>& own : later) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    count += static_cast<std::int64_t>(own.size());
    if (!own.empty()) later[own.front()].insert(later[own.front()].end(), own.begin() + 1, own.end());
  }
  return count;
}

TEST(DissectionTest, IsAPermutationWhateverThePlaces) {
  const SparseMatrix matrix = grid_matrix();
  for (const double scale : {1.0, 0.0}) {
    std::vector<int> order = dissection_order(matrix, scale * grid_places());
    std::sort(order.begin(), order.end());
    for (int k = 0; k < matrix.rows(); ++k) ASSERT_EQ(order[k], k);
  }
}

TEST(DissectionTest, FillsLessThanHalfOfTheNaturalOrder) {
  const SparseMatrix matrix = grid_matrix();
  std::vector<int> natural(matrix.rows());
  std::iota(natural.begin(), natural.end(), 0);
  EXPECT_LT(2 * fill(matrix, dissection_order(matrix, grid_places())), fill(matrix, natural));
}

TEST(DissectionTest, TheSolutionIsTheSame) {
  const SparseMatrix matrix = grid_matrix();
  Vector results[2];
  for (Vector& x : results) {
    LinearSolver solver(LinearSolverKind::kCholmod);
    solver.analyze(matrix, &x == results ? std::vector<int>() : dissection_order(matrix, grid_places()));
    solver.factorize(matrix);
    x = Vector::LinSpaced(matrix.rows(), -1.0, 1.0);
    solver.solve(x);
  }
  EXPECT_LT((results[0] - results[1]).norm(), 1e-13 * results[0].norm());
}

}  // namespace
}  // namespace reflines
