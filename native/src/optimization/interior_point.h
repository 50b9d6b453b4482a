// Estimates the active set of a bounded quadratic minimum by an interior point method.
#pragma once

#include <array>

#include "optimization/bounded_quadratic.h"

namespace reflines {

// Mehrotra's predictor-corrector method with Gondzio's further correctors (Comput. Optim. Appl. 6, 1996), stopped as
// soon as the active bounds are clear. Its number of factorizations hardly grows with the mesh, whereas an active set
// method removes one row of vertices with each.
class InteriorPoint {
 public:
  // Takes the model and its bounds; `reach` is the expected length of steps where a range is unbounded.
  InteriorPoint(const QuadraticModel& model, const Bounds& bounds, double reach);

  // Makes one iteration: one factorization and a few solves. Returns false once the estimate has settled.
  bool step(HeldFactor& factor, Report& counts, const Progress* progress);
  Sides guess() const;

 private:
  // The barrier of one end of every range: slack = sign (d - bound) > 0, and force > 0 is the multiplier of the bound.
  struct Barrier {
    double sign;
    Vector exists;  // 1, or 0 where the range is infinite or a point
    Vector bound;   // 0 there
    Vector slack;   // 1 there
    Vector force;   // 0 there
  };
  struct Change {
    Vector d;
    std::array<Vector, 2> slack, force;
  };
  using Products = std::array<Vector, 2>;  // wanted change of slack times force, for each barrier

  double stiffness(int k) const { return model_.H.valuePtr()[model_.H.outerIndexPtr()[k]]; }
  Barrier make_barrier(const Vector& bound, double sign, double force) const;
  Vector barrier_diagonal() const;
  Vector compute_missed_slack(const Barrier& barrier) const;
  Vector dual_residual() const;
  Change solve(HeldFactor& factor, const Products& products, bool residuals) const;
  Change predict_and_correct(HeldFactor& factor, Report& counts);
  bool correct_further(HeldFactor& factor, Change& change) const;
  double longest(const Change& change) const;
  double mean_product(const Change& change, double step) const;
  void move(const Change& change, double step);

  const QuadraticModel& model_;
  std::array<Barrier, 2> barriers_;  // low, high
  Sides fixed_;                      // unknowns that are always held: their range is a point
  Vector d_;
  Vector gradient_;  // gradient of the model at d
  int barrier_count_ = 0;
  double wanted_product_ = 0.0, first_product_ = 0.0;
  Sides last_guess_;
};

}  // namespace reflines
