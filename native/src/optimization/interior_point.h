// Which unknowns a bounded quadratic minimum holds, found from inside the bounds.
#pragma once

#include <array>

#include "optimization/bounded_quadratic.h"

namespace reflines {

// Mehrotra's predictor-corrector with Gondzio's further correctors (Comput. Optim. Appl. 6, 1996), stopped as soon as
// it is clear which bounds are touched. Its number of factorizations hardly grows with the mesh, where an active set
// shrinks by a row of vertices each.
class InteriorPoint {
 public:
  // `reach`: how far steps are expected to go where a range has no other end.
  InteriorPoint(const QuadraticModel& model, const Bounds& bounds, double reach);

  // One factorization and a few solves. False once the guess has settled.
  bool step(HeldFactor& factor, Report& counts);
  Sides guess() const;

 private:
  // One end of every range: slack = sign (d - bound) > 0 in the end, force > 0 is what the bound presses with.
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
  using Products = std::array<Vector, 2>;  // what slack times force is to change by, for each barrier

  double stiffness(int k) const { return model_.H.valuePtr()[model_.H.outerIndexPtr()[k]]; }
  Barrier make_barrier(const Vector& bound, double sign, double force) const;
  Vector barrier_diagonal() const;
  Vector missed_slack(const Barrier& barrier) const;
  Vector dual_residual() const;
  Change solve(const HeldFactor& factor, const Products& products, bool residuals) const;
  Change predict_and_correct(const HeldFactor& factor, Report& counts);
  bool correct_further(const HeldFactor& factor, Change& change) const;
  double longest(const Change& change) const;
  double mean_product(const Change& change, double step) const;
  void move(const Change& change, double step);

  const QuadraticModel& model_;
  std::array<Barrier, 2> barriers_;  // low, high
  Sides fixed_;                      // held all the time: their range is a point
  Vector d_;
  Vector gradient_;  // of the model at d
  int barrier_count_ = 0;
  double wanted_product_ = 0.0, first_product_ = 0.0;
  Sides last_guess_;
};

}  // namespace reflines
