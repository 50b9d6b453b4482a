#include "optimization/linear/elimination_path.h"

#include <algorithm>

namespace reflines {

EliminationPaths::EliminationPaths(const SupernodalFactor& factor) : factor_(factor), supernode_(factor.size) {
  for (int s = 0; s < factor.supernode_count; ++s)
    std::fill(supernode_.begin() + factor.first_column[s], supernode_.begin() + factor.first_column[s + 1], s);
}

SparseVector EliminationPaths::solve(int place, Vector& work) const {
  SparseVector y;
  work(place) = 1.0;
  for (int s = supernode_[place]; s >= 0;) {
    const int first = factor_.first_column[s], columns = factor_.first_column[s + 1] - first;
    const int height = factor_.row_start[s + 1] - factor_.row_start[s], below = height - columns;
    const Eigen::Map<const Eigen::MatrixXd> block(factor_.value + factor_.block_start[s], height, columns);
    Vector solved = work.segment(first, columns);
    block.topRows(columns).triangularView<Eigen::Lower>().solveInPlace(solved);
    work.segment(first, columns).setZero();
    for (int j = 0; j < columns; ++j) {
      if (solved(j) == 0.0) continue;
      y.index.push_back(first + j);
      y.value.push_back(solved(j));
    }
    const int* row = factor_.row + factor_.row_start[s] + columns;
    const Vector change = block.bottomRows(below) * solved;
    for (int i = 0; i < below; ++i) work(row[i]) -= change(i);
    s = below > 0 ? supernode_[row[0]] : -1;
  }
  return y;
}

}  // namespace reflines
