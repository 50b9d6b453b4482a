// A quadratic model minimized within limits of many linear functions by an interior point method.
#pragma once

#include <array>

#include "optimization/bounded_quadratic.h"
#include "optimization/held_factor.h"
#include "optimization/row_limits.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/types.h"

namespace reflines {

// Mehrotra's predictor-corrector method (SIAM J. Optim. 2, 1992) for a model's step d with low <= A d <= high. Each
// iteration makes one factor of H + A D A^T, D diagonal, whose pattern is that of H where every function depends on
// unknowns that H couples, so that nothing is analysed anew; their number hardly grows with that of the contacts.
class RowInteriorPoint {
 public:
  // Takes the model, the functions and their ranges (low <= 0 <= high); all outlive this.
  RowInteriorPoint(const QuadraticModel& model, const RowLimits::Narrow& limits, const Vector& low, const Vector& high);

  // Iterates until the functions are within their ranges but for `tolerance`, and what forces of functions farther than
  // that from an end, and the model's gradient, leave is at most `wanted`; or until no more digits are gained.
  // Overwrites the factor. Throws Cancelled.
  void run(HeldFactor& factor, double tolerance, double wanted, Report& counts, const Progress* progress);

  // Return the best step found, and its forces (#rows, > 0 upwards).
  const Vector& step() const { return best_step_; }
  const Vector& forces() const { return best_forces_; }

 private:
  // One end of every range: slack = sign (A d - bound) > 0, and force > 0 is its multiplier.
  struct End {
    double sign;
    Vector exists;  // 1, or 0 where the range is infinite
    Vector bound;   // 0 there
    Vector slack;   // 1 there
    Vector force;   // 0 there
  };
  struct Change {
    Vector d;
    std::array<Vector, 2> slack, force;
  };
  using Products = std::array<Vector, 2>;

  End make_end(const Vector& bound, double sign) const;
  void balance(double force);
  SparseMatrix build_matrix() const;
  Change solve(HeldFactor& factor, const Products& products) const;
  Change predict_and_correct(HeldFactor& factor) const;
  double longest(const Change& change) const;
  double mean_product(const Change& change, double step) const;
  void move(const Change& change);
  double measure_error(double tolerance, double wanted) const;
  Vector present_forces() const { return ends_[0].force - ends_[1].force; }
  Vector dual_residual() const;

  const QuadraticModel& model_;
  const RowLimits::Narrow& limits_;
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> by_unknown_;  // n x #rows: the functions of each unknown
  SparseMatrix matrix_;                                           // H + A D A^T
  std::array<End, 2> ends_;                                       // low, high
  Vector d_, values_;                                             // A d
  Vector best_step_, best_forces_;
};

}  // namespace reflines
