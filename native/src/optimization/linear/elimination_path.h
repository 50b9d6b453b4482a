// Triangular solves with sparse right-hand sides, along paths of the elimination tree.
#pragma once

#include <vector>

#include "optimization/linear/sparse_columns.h"
#include "optimization/linear/supernodal_factor.h"
#include "reflines/types.h"

namespace reflines {

// Solves L Y = B for sparse columns B. By the theorem of Gilbert and Peierls Y is not zero on the paths from B's rows
// to the root of the elimination tree only, so that a solve reads some columns of L instead of all: 2 % of 100,000 for
// a unit vector. Paths of neighbours are the same but for their first parts: those of several columns are taken at
// once, and the large blocks near the root are read once.
class EliminationPaths {
 public:
  explicit EliminationPaths(const SupernodalFactor& factor);

  // The entries of a right-hand side: rows of L, any order.
  struct Entry {
    int row, column;
    double value;
  };

  // Solves for columns given by their entries. `place` (n) is scratch, of any content.
  SparseColumns solve(const std::vector<Entry>& entries, int columns, std::vector<int>& place) const;

 private:
  std::vector<int> find_supernodes(const std::vector<Entry>& entries) const;

  SupernodalFactor factor_;
  std::vector<int> supernode_;  // n: of each column
};

}  // namespace reflines
