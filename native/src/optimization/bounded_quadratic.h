// A quadratic model g.d + d.H d / 2 of an energy, minimised within bounds.
#pragma once

#include "optimization/bounds.h"
#include "optimization/held_factor.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/types.h"

namespace reflines {

struct QuadraticModel {
  const SparseMatrix& H;  // lower triangle, n x n
  const Vector& gradient;

  Vector gradient_at(const Vector& d) const { return H.selfadjointView<Eigen::Lower>() * d + gradient; }
};

// The primal-dual active set method, a semismooth Newton method (Hintermueller, Ito and Kunisch, SIAM J. Optim. 13,
// 2003): solve with the held unknowns at their bounds, hold what went beyond, let go what is not pressed. Where the set
// settles too slowly, as on a smooth surface that leaves its bound row by row, InteriorPoint guesses it anew.
class BoundedQuadratic {
 public:
  // `counts` is told of factorizations and solves. `progress` may be null.
  BoundedQuadratic(HeldFactor& factor, Report& counts, Progress* progress)
      : factor_(factor), counts_(counts), progress_(progress) {}

  // Finds d within `bounds` with a projected gradient of at most `wanted`, or as small as `max_rounds` allow. `held`:
  // in, a guess; out, those of the factor that is left. False where told to stop.
  bool minimize(const QuadraticModel& model, const Bounds& bounds, double wanted, Sides& held, Vector& d);

 private:
  bool cancelled() const { return progress_ != nullptr && progress_->cancelled(); }
  Vector solve_held(const QuadraticModel& model, const Bounds& bounds, const Sides& held);
  bool keep_if_best(const QuadraticModel& model, const Bounds& bounds, const Vector& d, Vector& best);
  bool guess_from_inside(const QuadraticModel& model, const Bounds& bounds, double reach, Sides& held);

  HeldFactor& factor_;
  Report& counts_;
  Progress* progress_;
  double best_norm_ = 0.0;
};

// Those that a step went beyond, and of the held ones those that are still pressed against their bound.
Sides next_held(const Bounds& bounds, const Sides& held, const Vector& d, const Vector& gradient);

// What a step d, cut off at the bounds, leaves of the projected gradient because of that and of unknowns held wrongly.
double missed_norm(const QuadraticModel& model, const Bounds& bounds, const Sides& held, const Vector& d);

}  // namespace reflines
