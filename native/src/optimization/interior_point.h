// Minimizes a quadratic model within limits of linear functions by an interior point method.
#pragma once

#include "optimization/held_factor.h"
#include "optimization/quadratic_model.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

struct InteriorMinimum {
  Vector d, forces;  // forces: m, > 0 upwards
};

// Iterates until the functions are within their ranges, low <= 0 <= high, but for `tolerance`, and what forces of
// functions farther than that from an end, and the model's gradient, leave is at most `wanted`; or until no more digits
// are gained. `extent` is the expected size of a function where its range is infinite. Returns the best step found, and
// overwrites the factor. `progress` may be null. Throws Cancelled.
//
// Mehrotra's predictor-corrector method (SIAM J. Optim. 2, 1992) with Gondzio's further correctors (Comput. Optim.
// Appl. 6, 1996). Each iteration makes one factor of H + A^T D A, D diagonal, whose pattern is that of H where every
// function depends on unknowns that H couples; their number hardly grows with that of the contacts, where an active set
// method that leaves a bound row by row takes one for each.
InteriorMinimum minimize_from_inside(const QuadraticModel& model, const StepLimits& limits, double extent,
                                     double tolerance, double wanted, HeldFactor& factor, const Progress* progress);

}  // namespace reflines
