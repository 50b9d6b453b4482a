// Subtrees of a supernodal elimination tree that can be worked on at the same time.
#pragma once

#include <vector>

#include "optimization/linear/supernodal_factor.h"

namespace reflines {

// The elimination tree of the supernodes of a factor, which are in post-order, and disjoint subtrees of it. Columns of
// different subtrees do not depend on each other. The subtrees are chosen by the factor's structure alone, so that what
// is computed by subtrees has the same bits for any number of threads.
struct EliminationSubtrees {
  explicit EliminationSubtrees(const SupernodalFactor& factor);

  struct Range {
    int begin, end;  // of supernodes; the last one is the root
  };

  std::vector<int> supernode;   // n: of each column
  std::vector<int> parent;      // #supernodes: -1 for a root
  std::vector<Range> subtrees;  // ascending
  std::vector<int> above;       // the supernodes in no subtree, ascending; none in small factors
};

}  // namespace reflines
