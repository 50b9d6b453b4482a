// A quadratic model g.d + d.H d / 2 of an energy, and what its step d is to keep to.
#pragma once

#include "optimization/bounds.h"
#include "reflines/types.h"

namespace reflines {

struct QuadraticModel {
  const SparseMatrix& H;  // lower triangle, n x n
  const Vector& gradient;

  Vector gradient_at(const Vector& d) const { return H.selfadjointView<Eigen::Lower>() * d + gradient; }
};

// The limits low <= A d <= high.
struct StepLimits {
  const SparseMatrix* rows;  // A^T, n x m; null where A = I
  const Bounds& range;       // m; infinite where there is none
  const Sides& held;         // n: unknowns that stay at 0

  Vector values(const Vector& d) const { return rows == nullptr ? d : Vector(rows->transpose() * d); }
  Vector pull(const Vector& force) const { return rows == nullptr ? force : Vector(*rows * force); }
};

}  // namespace reflines
