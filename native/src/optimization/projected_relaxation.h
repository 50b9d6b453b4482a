// Estimates the active set of a bounded quadratic minimum by projected successive over-relaxation.
#pragma once

#include "optimization/bounds.h"
#include "optimization/quadratic_model.h"
#include "reflines/progress.h"

namespace reflines {

// Makes this many sweeps of projected successive over-relaxation, forth and back in turn, from the point within the
// bounds that is nearest to d (n). Returns the unknowns that are at their bounds then, and pressed against them; ends
// early where cancelled. `whole` is the model's H with both triangles, since a move changes the gradient in a whole
// column; `progress` may be null.
//
// Each unknown in turn goes to the minimum along it, somewhat beyond, and not over its bounds (Cryer, SIAM J. Control
// 9, 1971). For positive definite models that converges, slowly where the error is smooth, and at once where it is
// rough. Which unknowns of a noisy surface touch is decided within a few edges, so that some sweeps, which cost a
// quarter of a factorization, replace several rounds of the active set method, each of which takes one; the two
// alternate as in Morales, Nocedal and Smelyanskiy (Numer. Math. 111, 2008).
Sides relax_contacts(const QuadraticModel& model, const SparseMatrix& whole, const Bounds& bounds, const Vector& d,
                     int sweeps, const Progress* progress);

}  // namespace reflines
