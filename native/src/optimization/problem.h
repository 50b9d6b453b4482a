// The interface of a problem to the minimizer: a smooth function of n unknowns with an analytic gradient and a sparse
// Hessian model of constant pattern. It knows nothing of meshes; tests drive it with textbook functions.
#pragma once

#include <memory>

#include "reflines/types.h"

namespace reflines {

class CoarseProblem;

class Problem {
 public:
  virtual ~Problem() = default;

  virtual int size() const = 0;  // #unknowns n

  // Returns E(x) and, where `gradient` is not null, writes dE/dx into it (already of length n: no allocation in the
  // loop).
  virtual double evaluate(const Vector& x, Vector* gradient) = 0;

  // Returns the lower triangle of a second-order model, n x n, compressed; the pattern is the same for every x and
  // model, so that it is analysed once. The reference stays valid, and its values are overwritten, until the next call.
  virtual const SparseMatrix& hessian(const Vector& x, HessianModel model) = 0;

  // Returns a matrix with the pattern of every `hessian` without its values, where that is known before a point is;
  // else null.
  virtual const SparseMatrix* pattern() { return nullptr; }

  // Returns weights (n) such that the Euclidean norm of weight times relative rounding of the unknowns is that of the
  // gradient's rounding, given that Hessian. Where heights depend on fewer unknowns their own rounding counts, which
  // the small Hessian does not contain.
  virtual Vector rounding_weight(const SparseMatrix& hessian) { return hessian.diagonal(); }

  // Returns the places of the unknowns in a plane (n x 2), neighbours in the Hessian near each other, or nothing where
  // they have none. May run on another thread during `coarse`.
  virtual PlanePositions places() { return {}; }

  // Returns a coarse problem near x, where the gradient is `gradient`, that first approaches a distant minimum; null
  // where there is none. This problem outlives it.
  virtual std::unique_ptr<CoarseProblem> coarse(const Vector& x, const Vector& gradient);
};

// A coarse problem: far fewer unknowns c, the coefficients of smooth motions P, and an energy close to E(x + P c) at a
// fraction of its cost; the gradient at c = 0 is P^T times that of E.
class CoarseProblem : public Problem {
 public:
  virtual void move(const Vector& c, Vector& x) const = 0;  // x += P c
};

inline std::unique_ptr<CoarseProblem> Problem::coarse(const Vector&, const Vector&) { return nullptr; }

}  // namespace reflines
