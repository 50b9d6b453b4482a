// The factorization on all cores: subtrees, and tiles of the fronts above them, make the factor that UMFPACK confirms.
#include <gtest/gtest.h>

#include <vector>

#include "optimization/linear/elimination_subtrees.h"
#include "optimization/linear/linear_solver.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

// Adds a grid whose points are coupled with all that are at most two steps away, as unknowns from `first` on.
void add_grid(Triplets& entries, int side, int first) {
  for (int k = 0; k < side * side; ++k) {
    entries.emplace_back(first + k, first + k, 24.5 + 0.1 * (k % 7));
    for (int down = 0; down <= 2; ++down) {
      for (int right = down == 0 ? 1 : -2; right <= 2; ++right) {
        const int row = k / side + down, column = k % side + right;
        if (row >= side || column < 0 || column >= side) continue;
        entries.emplace_back(first + row * side + column, first + k, -1.0);
      }
    }
  }
}

SparseMatrix make_grids(const std::vector<int>& sides) {
  Triplets entries;
  int count = 0;
  for (const int side : sides) {
    add_grid(entries, side, count);
    count += side * side;
  }
  SparseMatrix lower(count, count);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

Vector solve_with(LinearSolverKind kind, const SparseMatrix& matrix, const Vector& right_side) {
  LinearSolver solver(kind);
  solver.analyze(matrix);
  solver.factorize(matrix);
  EXPECT_EQ(solver.diagonal_shift(), 0.0);
  Vector x = right_side;
  solver.solve(x);
  return x;
}

// One unknown; one subtree; subtrees, and fronts of more than one tile above them; trees of very different sizes.
TEST(MultifrontalCholesky, SolvesWhatUmfpackSolves) {
  for (const std::vector<int>& sides : std::vector<std::vector<int>>{{1}, {12}, {260}, {1, 110, 2, 40, 60}}) {
    const SparseMatrix matrix = make_grids(sides);
    const Vector right_side = Vector::LinSpaced(matrix.rows(), -1.0, 2.0);
    const Vector x = solve_with(LinearSolverKind::kCholmod, matrix, right_side);
    const Vector expected = solve_with(LinearSolverKind::kUmfpack, matrix, right_side);
    EXPECT_LT((x - expected).norm(), 1e-12 * expected.norm()) << sides.size();
  }
}

TEST(MultifrontalCholesky, NewValuesLeaveNothingOfTheOldOnes) {
  const SparseMatrix first = make_grids({120}), second = 0.5 * first;
  const Vector right_side = Vector::LinSpaced(first.rows(), -1.0, 2.0);
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(first);
  Vector x;
  for (const SparseMatrix* matrix : {&first, &second, &first}) {
    solver.factorize(*matrix);
    x = right_side;
    solver.solve(x);
  }
  EXPECT_EQ(x, solve_with(LinearSolverKind::kCholmod, first, right_side));
}

// A pivot that is not positive is found in subtrees and above them, and the factor after it is whole.
TEST(MultifrontalCholesky, FindsANegativePivotAnywhere) {
  const SparseMatrix sound = make_grids({120});
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(sound);
  const Vector right_side = Vector::Ones(sound.rows());
  for (int k = 0; k < sound.rows(); k += 1111) {
    SparseMatrix matrix = sound;
    matrix.coeffRef(k, k) = -1.0;
    EXPECT_THROW(solver.factorize(matrix), SolverFailure) << k;
  }
  solver.factorize(sound);
  Vector x = right_side;
  solver.solve(x);
  EXPECT_EQ(x, solve_with(LinearSolverKind::kCholmod, sound, right_side));
}

// Seven supernodes of one column each: 0 and 1 below 2, 3 and 4 below 5, 2 and 5 below 6.
TEST(EliminationSubtrees, KnowsParentsAndKeepsSmallTreesWhole) {
  const std::vector<int> first = {0, 1, 2, 3, 4, 5, 6, 7}, row_start = {0, 2, 4, 6, 8, 10, 12, 13};
  const std::vector<int> block_start = {0, 2, 4, 6, 8, 10, 12}, row = {0, 2, 1, 2, 2, 6, 3, 5, 4, 5, 5, 6, 6};
  const SupernodalFactor factor{7, 7, first.data(), row_start.data(), block_start.data(), row.data(), nullptr};
  const EliminationSubtrees tree(factor);
  EXPECT_EQ(tree.parent, (std::vector<int>{2, 2, 6, 5, 5, 6, -1}));
  EXPECT_TRUE(tree.above.empty());
  ASSERT_EQ(tree.subtrees.size(), 1u);
  EXPECT_EQ(tree.subtrees[0].begin, 0);
  EXPECT_EQ(tree.subtrees[0].end, 7);
}

}  // namespace
}  // namespace reflines
