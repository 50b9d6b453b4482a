// A quadratic model g.d + d.H d / 2 of an energy, minimized within bounds.
#pragma once

#include "optimization/bounds.h"
#include "optimization/held_factor.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/types.h"

namespace reflines {

class ProjectedRelaxation;

struct QuadraticModel {
  const SparseMatrix& H;  // lower triangle, n x n
  const Vector& gradient;

  Vector gradient_at(const Vector& d) const { return H.selfadjointView<Eigen::Lower>() * d + gradient; }
};

// A minimum that touches its bounds at few unknowns, as smooth surfaces do at their highest places, is found with few
// factors: from the free minimum on, unknowns are held at the peaks of the violation, and those that pull are released
// (an active set method of the dual kind, as Goldfarb and Idnani's, Math. Program. 27, 1983). Of a noisy panel of
// 10,000 vertices 5 (43) touch the limit, where hundreds of the free minimum are beyond it: 2 factorizations and 18
// (30) solves instead of 14 (20) factorizations and 46 (74) solves; of 100,000 vertices 17, 3 factorizations and 37
// solves instead of more than 90 factorizations.
//
// Others are found by the primal-dual active set method, a semismooth Newton method (Hintermueller, Ito and Kunisch,
// SIAM J. Optim. 13, 2003): solve with the held unknowns at their bounds, hold those that violate a bound, release
// those with a multiplier of the wrong sign. Its first rounds would change thousands of unknowns, and take a
// factorization each: ProjectedRelaxation changes most of these before. The later ones change few and take the factor
// before them, bordered. Where the set of many changes slowly, as on a smooth surface that leaves its bound row by row,
// InteriorPoint estimates it anew.
class BoundedQuadratic {
 public:
  // Takes the factor to use; `counts` collects factorizations and solves. `progress` may be null.
  BoundedQuadratic(HeldFactor& factor, Report& counts, Progress* progress)
      : factor_(factor), counts_(counts), progress_(progress) {}

  // Finds d within `bounds` with a projected gradient of at most `wanted`, or as small as the rounds allow. `held` is
  // an estimate on entry, and the set of the remaining factor on return. `many` tells that few contacts were searched
  // in vain, and is set then. Returns false where cancelled.
  bool minimize(const QuadraticModel& model, const Bounds& bounds, double wanted, Sides& held, bool& many, Vector& d);

 private:
  enum class Search { kFound, kTooMany, kCancelled };
  Search search_contacts(const QuadraticModel& model, const Bounds& bounds, double wanted, Sides& held, Vector& d);
  void factorize(const QuadraticModel& model, const Sides& held);
  void hold(const QuadraticModel& model, const Bounds& bounds, const Sides& held);
  bool settle(const QuadraticModel& model, const Bounds& bounds, double wanted, ProjectedRelaxation& relaxation,
              Sides& held, Vector& d);
  bool cancelled() const { return progress_ != nullptr && progress_->cancelled(); }
  struct Trial {
    Vector d, gradient;  // of the model at d
  };
  Trial minimize_held(const QuadraticModel& model, const Bounds& bounds, double wanted, const Sides& held,
                      Vector& best);
  void release_pulling(const QuadraticModel& model, const Bounds& bounds, Sides& held);
  static Vector right_side(const QuadraticModel& model, const Vector& left_out);
  Trial solve_held(const QuadraticModel& model, const Bounds& bounds, const Sides& held);
  double keep_if_best(const QuadraticModel& model, const Bounds& bounds, const Trial& trial, Vector& best);
  bool guess_from_inside(const QuadraticModel& model, const Bounds& bounds, double reach, Sides& held);

  HeldFactor& factor_;
  Report& counts_;
  Progress* progress_;
  double best_norm_ = 0.0;
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
