// Minimizes a quadratic model within limits of linear functions by an interior point method.
#pragma once

#include <array>
#include <utility>

#include "optimization/held_factor.h"
#include "optimization/quadratic_model.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// Mehrotra's predictor-corrector method (SIAM J. Optim. 2, 1992) with Gondzio's further correctors (Comput. Optim.
// Appl. 6, 1996). Each iteration makes one factor of H + A^T D A, D diagonal, whose pattern is that of H where every
// function depends on unknowns that H couples; their number hardly grows with that of the contacts, where an active set
// method that leaves a bound row by row takes one for each.
class InteriorPoint {
 public:
  // Takes what outlives it, the limits with low <= 0 <= high. `extent` is the expected size of a function where its
  // range is infinite. `progress` may be null. The factor is overwritten.
  InteriorPoint(const QuadraticModel& model, const StepLimits& limits, double extent, HeldFactor& factor,
                const Progress* progress);

  // Iterates until the functions are within their ranges but for `tolerance`, and what forces of functions farther than
  // that from an end, and the model's gradient, leave is at most `wanted`; or until no more digits are gained. Returns
  // the best step found, and its forces (m, > 0 upwards). Throws Cancelled.
  struct Minimum {
    Vector d, forces;
  };
  Minimum minimize(double tolerance, double wanted);

 private:
  // One end of every range: slack = sign (A d - bound) > 0, and force > 0 is its multiplier.
  struct End {
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
  using Products = std::array<Vector, 2>;  // wanted change of slack times force, at each end

  End make_end(const Vector& bound, double sign) const;
  void place_start(double extent);
  SparseMatrix build_matrix() const;
  Vector dual_residual() const;
  Vector solve_system(const Vector& right);
  Change solve(const Products& products, bool residuals);
  std::pair<Change, double> predict_and_correct();
  bool correct_further(Change& change, double wanted_product);
  double longest(const Change& change) const;
  double mean_product() const { return mean_product({}, 0.0); }
  double mean_product(const Change& change, double step) const;
  void iterate();
  double measure_error(double tolerance, double wanted) const;
  Vector present_forces() const { return ends_[0].force - ends_[1].force; }

  const QuadraticModel& model_;
  const StepLimits& limits_;
  HeldFactor& factor_;
  const Progress* progress_;
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> by_unknown_;  // n x m: the functions of each unknown; empty: A = I
  SparseMatrix matrix_;                                           // H + A^T D A
  std::array<End, 2> ends_;                                       // low, high
  Vector d_, values_;                                             // A d
};

}  // namespace reflines
