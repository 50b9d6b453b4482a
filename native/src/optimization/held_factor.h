// A factor of the rows and columns of a matrix that belong to unknowns which are not held.
#pragma once

#include "optimization/bounds.h"
#include "optimization/linear/linear_solver.h"
#include "reflines/types.h"

namespace reflines {

// Rows and columns of held unknowns are cleared but for their diagonal: the pattern, and with it the symbolic analysis,
// stays that of the whole matrix.
class HeldFactor {
 public:
  explicit HeldFactor(LinearSolver& solver) : solver_(solver) {}

  // Of H, with `added` (n, or empty) on its diagonal. Lower triangle, analysed by the solver before.
  void factorize(const SparseMatrix& H, const Sides& held, const Vector& added = {});
  // 0 for held unknowns, whatever is asked there.
  void solve(const Sides& held, Vector& x) const;

 private:
  LinearSolver& solver_;
  SparseMatrix matrix_;
};

}  // namespace reflines
