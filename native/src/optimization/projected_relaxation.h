// Estimates the active set of a bounded quadratic minimum by projected successive over-relaxation.
#pragma once

#include "optimization/bounds.h"
#include "optimization/quadratic_model.h"
#include "reflines/progress.h"

namespace reflines {

// Projected successive over-relaxation (Cryer, SIAM J. Control 9, 1971): each unknown in turn goes to the minimum along
// it, somewhat beyond, and not over its bounds. For positive definite models it converges, slowly where the error is
// smooth, and at once where it is rough. Which unknowns of a noisy surface touch is decided within a few edges, so that
// some sweeps, which cost a quarter of a factorization, replace several rounds of the active set method, each of which
// takes one; the two alternate as in Morales, Nocedal and Smelyanskiy (Numer. Math. 111, 2008).
class ProjectedRelaxation {
 public:
  // Takes the model and its bounds, which outlive it. `progress` may be null.
  ProjectedRelaxation(const QuadraticModel& model, const Bounds& bounds, const Progress* progress);

  // Makes this many sweeps, forth and back in turn, from the point within the bounds that is nearest to d (n). Returns
  // the unknowns that are at their bounds then, and pressed against them; ends early where cancelled.
  Sides estimate_held(const Vector& d, int sweeps);

 private:
  void sweep(bool backwards, double relaxation, Vector& d, Vector& gradient) const;

  const QuadraticModel& model_;
  const Bounds& bounds_;
  const Progress* progress_;
  SparseMatrix H_;  // both triangles, since a move changes the gradient in a whole column; empty before the first sweep
};

}  // namespace reflines
