#include "optimization/linear/elimination_path.h"

#include <algorithm>
#include <set>

namespace reflines {

EliminationPaths::EliminationPaths(const SupernodalFactor& factor) : factor_(factor), supernode_(factor.size) {
  for (int s = 0; s < factor.supernode_count; ++s)
    std::fill(supernode_.begin() + factor.first_column[s], supernode_.begin() + factor.first_column[s + 1], s);
}

// Returns the supernodes of all paths, each after those below it: a tree's parents have larger numbers.
std::vector<int> EliminationPaths::find_supernodes(const std::vector<Entry>& entries) const {
  std::set<int> found;
  for (const Entry& entry : entries) {
    for (int s = supernode_[entry.row]; found.insert(s).second && factor_.below(s) > 0;)
      s = supernode_[factor_.rows_below(s)[0]];
  }
  return {found.begin(), found.end()};
}

SparseColumns EliminationPaths::solve(const std::vector<Entry>& entries, int columns, std::vector<int>& place) const {
  const std::vector<int> supernodes = find_supernodes(entries);
  SparseColumns y;
  for (const int s : supernodes) {
    for (int j = factor_.first_column[s]; j < factor_.first_column[s + 1]; ++j) {
      place[j] = static_cast<int>(y.row.size());
      y.row.push_back(j);
    }
  }
  y.value.setZero(static_cast<Eigen::Index>(y.row.size()), columns);
  for (const Entry& entry : entries) y.value(place[entry.row], entry.column) += entry.value;
  for (const int s : supernodes) {
    const Eigen::Map<const Eigen::MatrixXd> block(factor_.block(s), factor_.height(s), factor_.columns(s));
    auto solved = y.value.middleRows(place[factor_.first_column[s]], block.cols());
    block.topRows(block.cols()).triangularView<Eigen::Lower>().solveInPlace(solved);
    const Eigen::MatrixXd change = block.bottomRows(factor_.below(s)) * solved;
    for (int i = 0; i < factor_.below(s); ++i) y.value.row(place[factor_.rows_below(s)[i]]) -= change.row(i);
  }
  return y;
}

}  // namespace reflines
