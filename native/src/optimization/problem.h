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

  // E(x) and, where `gradient` is not null, dE/dx into it (already of length n: no allocation in the loop).
  virtual double evaluate(const Vector& x, Vector* gradient) = 0;

  // Lower triangle, n x n, compressed; the pattern is the same for every x and model, so that it is analysed once.
  // The reference stays valid, and its values are overwritten, until the next call.
  virtual const SparseMatrix& hessian(const Vector& x, HessianModel model) = 0;

  // A matrix with the pattern of every `hessian`, its values not set, where that is known before a point is; else null.
  virtual const SparseMatrix* pattern() { return nullptr; }

  // n: what rounding each unknown by one part does to the gradient, as a Euclidean norm, given that Hessian. Where
  // heights follow fewer unknowns their own rounding counts, which the small Hessian does not know.
  virtual Vector rounding_weight(const SparseMatrix& hessian) { return hessian.diagonal(); }

  // Where each unknown lies in a plane (n x 2), if it does: neighbours in the Hessian near each other. Empty: unknown.
  // May run in a thread of its own, beside `coarse`.
  virtual PlanePositions places() { return {}; }

  // A stand-in near x, where the gradient is `gradient`, with which a minimum far away is first approached. Null where
  // the problem knows of none. The problem outlives it.
  virtual std::unique_ptr<CoarseProblem> coarse(const Vector& x, const Vector& gradient);
};

// Far fewer unknowns c, the strengths of smooth motions P, and an energy close to E(x + P c) that costs a fraction of
// it; the gradient at c = 0 is that of E.
class CoarseProblem : public Problem {
 public:
  virtual void move(const Vector& c, Vector& x) const = 0;  // x += P c
};

inline std::unique_ptr<CoarseProblem> Problem::coarse(const Vector&, const Vector&) { return nullptr; }

}  // namespace reflines
