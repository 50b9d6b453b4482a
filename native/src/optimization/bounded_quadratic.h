// A quadratic model g.d + d.H d / 2 of an energy, minimized within bounds that many unknowns touch.
#pragma once

#include "optimization/bounds.h"
#include "optimization/held_factor.h"
#include "optimization/quadratic_model.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// Finds d within the bounds with a projected gradient as wanted, or as small as the rounds allow.
//
// Unknowns that touch their bounds are eliminated from the factor, by the primal-dual active set method, a semismooth
// Newton method (Hintermueller, Ito and Kunisch, SIAM J. Optim. 13, 2003): solve with the held unknowns at their
// bounds, hold those that violate a bound, release those with a multiplier of the wrong sign. relax_contacts makes the
// large first changes of the set, a bordered factor the small last ones, and an interior point method estimates it anew
// where sets follow each other in a ring. ContactQuadratic needs fewer factors where few touch.
//
// `held` is an estimate; where it is empty one is made from the point d. `progress` may be null. Throws Cancelled.
struct BoundedMinimum {
  Vector d;
  Sides held;  // by the remaining factor
};
BoundedMinimum minimize_bounded(const QuadraticModel& model, const Bounds& bounds, double wanted, Sides held,
                                const Vector& d, HeldFactor& factor, Progress* progress);

// Returns the part of the projected gradient that a step d, projected onto the bounds, leaves because of the projection
// and of wrongly held unknowns.
double measure_missed_gradient(const QuadraticModel& model, const Bounds& bounds, const Sides& held, const Vector& d);

}  // namespace reflines
