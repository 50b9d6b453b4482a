#include "optimization/linear/elimination_path.h"

#include <memory>
#include <set>

namespace reflines {

SparseColumns solve_along_paths(const SupernodalFactor& factor, const EliminationSubtrees& tree,
                                const SparseColumns& B) {
  std::set<int> supernodes;  // of all paths, each after those below it: a tree's parents have larger numbers
  for (const int row : B.row) {
    for (int s = tree.supernode[row]; s >= 0 && supernodes.insert(s).second;) s = tree.parent[s];
  }
  const auto place = std::make_unique_for_overwrite<int[]>(factor.size);  // in y of the rows that it has
  SparseColumns y{B.count, {}, {}};
  for (const int s : supernodes) {
    for (int j = factor.first_column[s]; j < factor.first_column[s + 1]; ++j) {
      place[j] = static_cast<int>(y.row.size());
      y.row.push_back(j);
    }
  }
  y.value.setZero(static_cast<Eigen::Index>(y.row.size()), SparseColumns::kWidth);
  for (size_t i = 0; i < B.row.size(); ++i) y.value.row(place[B.row[i]]) = B.value.row(static_cast<Eigen::Index>(i));
  for (const int s : supernodes) {
    const Eigen::Map<const Eigen::MatrixXd> block(factor.block(s), factor.height(s), factor.columns(s));
    auto solved = y.value.middleRows(place[factor.first_column[s]], block.cols());
    block.topRows(block.cols()).triangularView<Eigen::Lower>().solveInPlace(solved);
    const SparseColumns::Rows change = block.bottomRows(factor.below(s)) * solved;
    for (int i = 0; i < factor.below(s); ++i) y.value.row(place[factor.rows_below(s)[i]]) -= change.row(i);
  }
  return y;
}

}  // namespace reflines
