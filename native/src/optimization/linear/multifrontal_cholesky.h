// Numeric Cholesky factorization by the multifrontal method, on all cores.
#pragma once

#include <memory>
#include <vector>

#include "optimization/linear/dense_front.h"
#include "optimization/linear/elimination_subtrees.h"
#include "optimization/linear/supernodal_factor.h"
#include "reflines/types.h"

namespace reflines {

// Computes the values of a supernodal factor, whose structure CHOLMOD has found, by the multifrontal method (Duff and
// Reid, ACM Trans. Math. Software 9, 1983; Liu, SIAM Review 34, 1992): each supernode adds the update matrices of its
// children to its columns, factors them densely, and leaves an update matrix to its parent. Subtrees of the elimination
// tree are factored at the same time, and the few large fronts above them by tiles on all cores: it takes 0.6 of the
// time of CHOLMOD's own factorization on two cores, whose fronts are too small here to gain by threads.
class MultifrontalCholesky {
 public:
  // Takes the structure of the factor, whose values may be allocated later, of a matrix with this pattern (lower
  // triangle), and the order of elimination (n, first to last).
  MultifrontalCholesky(const SupernodalFactor& factor, const SparseMatrix& pattern, const int* order);

  // Computes the factor's `value` from those of the matrix (#entries). Returns false where a pivot is not positive, and
  // throws std::bad_alloc where memory runs out.
  bool factorize(const double* values, double* factor);

  const EliminationSubtrees& tree() const { return tree_; }

 private:
  int find_row(int s, int i) const;
  void find_targets(const SparseMatrix& pattern, const int* order);
  void copy_values(const double* values);
  bool factorize_subtree(const EliminationSubtrees::Range& subtree);
  bool factorize_supernode(int s, bool split);
  void add_update(int child, const DenseFront& front, const int* rows, bool split) const;

  SupernodalFactor factor_;
  EliminationSubtrees tree_;
  std::vector<std::vector<int>> children_;          // #supernodes
  std::vector<int> target_;                         // #entries: their places in the factor
  std::vector<std::unique_ptr<double[]>> updates_;  // #supernodes: until the parent has taken them
};

}  // namespace reflines
