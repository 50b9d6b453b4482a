// A quadratic model g.d + d.H d / 2 of an energy, minimized within bounds.
#pragma once

#include <limits>
#include <optional>

#include "optimization/bounds.h"
#include "optimization/held_factor.h"
#include "optimization/quadratic_model.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/types.h"

namespace reflines {

class ProjectedRelaxation;

// Finds a minimum that touches its bounds at few unknowns, as smooth surfaces do at their highest places, with few
// factors: from the free minimum on, unknowns are held at the peaks of the violation, and those that pull are released
// (an active set method of the dual kind, as Goldfarb and Idnani's, Math. Program. 27, 1983).
//
// Others are found by the primal-dual active set method, a semismooth Newton method (Hintermueller, Ito and Kunisch,
// SIAM J. Optim. 13, 2003): solve with the held unknowns at their bounds, hold those that violate a bound, release
// those with a multiplier of the wrong sign. ProjectedRelaxation makes the large first changes of the set, a bordered
// factor the small last ones, and InteriorPoint estimates it anew where sets follow each other in a ring.
class BoundedQuadratic {
 public:
  // Takes the model, its bounds and the projected gradient that is wanted; `counts` collects factorizations and solves.
  // All outlive it; `progress` may be null.
  BoundedQuadratic(const QuadraticModel& model, const Bounds& bounds, double wanted, HeldFactor& factor, Report& counts,
                   Progress* progress);

  // Finds d within the bounds with a projected gradient as wanted, or as small as the rounds allow. `held` is an
  // estimate, `many` tells that few contacts were searched in vain before. Throws Cancelled.
  struct Minimum {
    Vector d;
    Sides held;  // by the remaining factor
    bool many;
  };
  Minimum minimize(Sides held, bool many);

 private:
  std::optional<Sides> search_contacts(Sides held);
  Sides settle(ProjectedRelaxation& relaxation, Sides held);
  struct Trial {
    Vector d, gradient;  // of the model at d
  };
  Trial minimize_held(const Sides& held);
  Trial solve_held(const Sides& held);
  void keep_if_best(const Trial& trial);
  Sides release_pulling(Sides held);
  Sides estimate_from_inside(double extent);
  void factorize(const Sides& held);
  void hold(const Sides& held);
  Vector right_side(const Vector& left_out) const;
  bool is_few(const Sides& held) const;

  const QuadraticModel& model_;
  const Bounds& bounds_;
  double wanted_;
  HeldFactor& factor_;
  Report& counts_;
  Progress* progress_;
  Sides points_;
  Vector best_;
  double best_norm_ = std::numeric_limits<double>::infinity();
};

// Returns the unknowns that a step moved beyond their bound, and of the held ones those whose multiplier has the right
// sign.
Sides next_held(const Bounds& bounds, const Sides& held, const Vector& d, const Vector& gradient);

// Returns those of `next` that were held before, and of the new ones the farthest beyond its bounds at d in each patch:
// a set of unknowns beyond their bounds that the lower triangle H couples. Of many peaks those far below the highest
// are left out.
Sides keep_peaks(const SparseMatrix& H, const Bounds& bounds, const Sides& held, const Sides& next, const Vector& d);

// Returns the part of the projected gradient that a step d, projected onto the bounds, leaves because of the projection
// and of wrongly held unknowns.
double measure_missed_gradient(const QuadraticModel& model, const Bounds& bounds, const Sides& held, const Vector& d);

}  // namespace reflines
