// Limits of linear functions of the unknowns: those of a surface's heights that follow fewer unknowns, and bounds of
// the unknowns themselves.
#pragma once

#include <vector>

#include "optimization/bounds.h"
#include "reflines/types.h"

namespace reflines {

SparseMatrix select_columns(const SparseMatrix& matrix, const std::vector<int>& columns);

// The limits low <= modes^T (x - origin) <= high, or low <= x <= high. They are in terms of what the caller limits;
// narrow() prepares the form that a minimization works with.
class RowLimits {
 public:
  // Takes `modes` (n x m), which outlives this: column i holds the weights of function i, none of them negative; low
  // and high (m), low <= 0 <= high, which may be infinite; and the origin (n), where all functions are 0. `rounding` is
  // the error of a function's value as its caller measures it. Throws InvalidInput for a negative weight.
  RowLimits(const SparseMatrix& modes, Vector low, Vector high, Vector origin, double rounding);
  RowLimits(const Bounds& bounds);  // NOLINT(google-explicit-constructor): every function is an unknown

  bool are_bounds() const { return modes_ == nullptr; }
  Vector values(const Vector& x) const;  // m
  // Returns whether all functions are within the limits, in spite of rounding.
  bool contain(const Vector& x) const;
  int count_beyond(const Vector& x) const;  // functions that are not
  double extent(const Vector& x) const { return values(x).cwiseAbs().maxCoeff(); }
  bool are_zero() const { return range_.low.isZero(0) && range_.high.isZero(0); }

  struct Narrow;
  // Narrows the limits by a tolerance, a fraction of the smaller one of `extent`, the largest value that the functions
  // would have, and of the largest finite limit: results that are within that tolerance of the narrow limits are within
  // the limits themselves. Bounds, which are kept to the last bit, stay as they are.
  Narrow narrow(double extent) const;

 private:
  double choose_tolerance(double extent) const;

  const SparseMatrix* modes_ = nullptr;  // null: the unknowns themselves
  Bounds range_;
  Vector origin_;
  double rounding_ = 0.0;
};

// Narrow limits: every function is a mean of unknowns, the weights of which sum to 1, so that one tolerance suits those
// that depend on unknowns by 1e-6, too; functions that are equal are one.
struct RowLimits::Narrow {
  SparseMatrix rows;        // n x #rows, each column a mean
  bool are_bounds = false;  // rows = I, and origin = 0
  Bounds range;             // #rows
  Vector origin;            // n
  double tolerance = 0.0;
  // The unknowns that stay where they are, since they would move functions that cannot grow and others that cannot
  // fall; functions that can do neither are both.
  Sides held;   // n
  Vector base;  // n: a point within the narrow limits next to the origin; none of bounds

  Vector values(const Vector& x) const { return rows.transpose() * (x - origin); }
  bool may_move() const { return count_held(held) < static_cast<int>(held.size()); }
  // Returns a point within the narrow limits: with each unknown at the nearest end of its bounds, or on the way from
  // the base to x.
  Vector move_inside(const Vector& x) const { return are_bounds ? clip(x) : pull_inside(base, x); }
  // Returns the farthest point on the way from a point within the narrow limits to another that is within them, too.
  Vector pull_inside(const Vector& from, const Vector& to) const;
  // Returns the end of a step, cut to the bounds, or so short that it ends within the tolerance of the narrow limits: a
  // model's solution that lacks digits may be farther beyond.
  Vector end_step(const Vector& x, const Vector& step) const;
  Vector clip(const Vector& x) const { return are_bounds ? range.nearest(x) : x; }
  void merge_equal(const Vector& sum);
};

}  // namespace reflines
