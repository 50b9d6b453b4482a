// A factor of the rows and columns of a matrix that belong to unknowns which are not held.
#pragma once

#include "optimization/bounds.h"
#include "optimization/linear/linear_solver.h"
#include "reflines/types.h"

namespace reflines {

// The factor of H with the rows and columns of held unknowns cleared except for their diagonal: the pattern, and with
// it the symbolic analysis, stays that of the whole matrix.
class HeldFactor {
 public:
  // Keeps references to both; `progress` may be null.
  HeldFactor(LinearSolver& solver, const Progress* progress) : solver_(solver), progress_(progress) {}

  // Factors H (lower triangle, analysed by the solver before), with `added` (n, or empty) on its diagonal.
  // Throws Cancelled.
  void factorize(const SparseMatrix& H, const Sides& held, const Vector& added = {});
  // Solves for x; held unknowns become 0, whatever their right-hand side.
  void solve(const Sides& held, Vector& x) const;

 private:
  LinearSolver& solver_;
  const Progress* progress_;
  SparseMatrix matrix_;
};

}  // namespace reflines
