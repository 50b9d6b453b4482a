// A quadratic model g.d + d.H d / 2 of an energy, minimized within bounds that many unknowns touch.
#pragma once

#include <limits>

#include "optimization/bounds.h"
#include "optimization/held_factor.h"
#include "optimization/projected_relaxation.h"
#include "optimization/quadratic_model.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// Unknowns that touch their bounds are eliminated from the factor, by the primal-dual active set method, a semismooth
// Newton method (Hintermueller, Ito and Kunisch, SIAM J. Optim. 13, 2003): solve with the held unknowns at their
// bounds, hold those that violate a bound, release those with a multiplier of the wrong sign. ProjectedRelaxation makes
// the large first changes of the set, a bordered factor the small last ones, and InteriorPoint estimates it anew where
// sets follow each other in a ring. ContactQuadratic needs fewer factors where few touch.
class BoundedQuadratic {
 public:
  // Takes the model, its bounds and the projected gradient that is wanted. All outlive it; `progress` may be null.
  BoundedQuadratic(const QuadraticModel& model, const Bounds& bounds, double wanted, HeldFactor& factor,
                   Progress* progress);

  // Returns the unknowns that are held where none was known before, from a point d on.
  Sides estimate_held(const Vector& d);

  // Finds d within the bounds with a projected gradient as wanted, or as small as the rounds allow. `held` is an
  // estimate. Throws Cancelled.
  struct Minimum {
    Vector d;
    Sides held;  // by the remaining factor
  };
  Minimum minimize(Sides held);

 private:
  Vector minimize_held(const Sides& held);
  void hold(const Sides& held);
  void keep_if_best(const Vector& d, const Vector& gradient);
  Sides estimate_from_inside(const Vector& d);

  const QuadraticModel& model_;
  const Bounds& bounds_;
  double wanted_;
  HeldFactor& factor_;
  Progress* progress_;
  ProjectedRelaxation relaxation_;
  Vector best_;
  double best_norm_ = std::numeric_limits<double>::infinity();
};

// Returns the part of the projected gradient that a step d, projected onto the bounds, leaves because of the projection
// and of wrongly held unknowns.
double measure_missed_gradient(const QuadraticModel& model, const Bounds& bounds, const Sides& held, const Vector& d);

}  // namespace reflines
