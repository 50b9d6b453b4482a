// What a minimizer sees: a smooth function of n unknowns with an analytic gradient and a sparse Hessian model of
// constant pattern. It knows nothing of meshes; tests drive it with textbook functions.
#pragma once

#include "native/types.h"

namespace reflines {

class Problem {
 public:
  virtual ~Problem() = default;

  virtual int size() const = 0;  // #unknowns n

  // E(x) and, where `gradient` is not null, dE/dx into it (already of length n: no allocation in the loop).
  virtual double evaluate(const Vector& x, Vector* gradient) = 0;

  // Lower triangle, n x n, compressed; the pattern is the same for every x and model, so that it is analysed once.
  // The reference stays valid, and its values are overwritten, until the next call.
  virtual const SparseMatrix& hessian(const Vector& x, HessianModel model) = 0;

  // P^T, m x n with m much smaller than n: column j says by how much each of m smooth motions moves unknown j. A
  // minimum far away is first approached along them. Null where the problem knows of none.
  virtual const SparseMatrix* smooth_modes() { return nullptr; }
};

}  // namespace reflines
