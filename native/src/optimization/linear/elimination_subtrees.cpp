#include "optimization/linear/elimination_subtrees.h"

#include <algorithm>

namespace reflines {
namespace {

// The part of the factor's entries that a subtree has at most: enough subtrees for eight cores.
constexpr double kLargestSubtree = 1.0 / 8.0;

// The number of entries below which one core is used: a factorization of them takes 1 ms, and a solve 0.1.
constexpr double kFewEntries = 200000;

}  // namespace

EliminationSubtrees::EliminationSubtrees(const SupernodalFactor& factor)
    : supernode(factor.size), parent(factor.supernode_count, -1) {
  const int count = factor.supernode_count;
  std::vector<int> first(count);
  std::vector<double> entries(count, 0.0);  // of the subtree below each
  for (int s = 0; s < count; ++s) {
    std::fill(supernode.begin() + factor.first_column[s], supernode.begin() + factor.first_column[s + 1], s);
    first[s] = s;
  }
  double all = 0.0;
  for (int s = 0; s < count; ++s) {
    const double columns = factor.columns(s), height = factor.height(s);
    all += columns * height;
    entries[s] += columns * height;
    if (height == columns) continue;
    const int p = parent[s] = supernode[factor.rows_below(s)[0]];
    entries[p] += entries[s];
    first[p] = std::min(first[p], first[s]);
  }
  const double most = all < kFewEntries ? all : kLargestSubtree * all;
  for (int s = 0; s < count; ++s) {
    if (entries[s] > most)
      above.push_back(s);
    else if (parent[s] < 0 || entries[parent[s]] > most)
      subtrees.push_back({first[s], s + 1});
  }
}

}  // namespace reflines
