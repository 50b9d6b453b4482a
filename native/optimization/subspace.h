// A problem restricted to a few smooth motions: E(origin + P c) over the m coefficients c, by Galerkin projection.
#pragma once

#include "native/optimization/galerkin.h"
#include "native/optimization/problem.h"

namespace reflines {

// A cheap first approach to a minimum that is far away: one coarse Hessian costs a fraction of the fine one to factor.
class Subspace final : public Problem {
 public:
  // A point of the whole problem with its energy and gradient.
  struct Point {
    Vector x, gradient;
    double energy = 0.0;
  };

  // `modes` is P^T, m x n, as Problem::smooth_modes hands it out; it and the problem outlive the subspace.
  Subspace(Problem& whole, const SparseMatrix& modes, Point origin);

  const Point& point(const Vector& c);              // at origin + P c, valid until the next call
  int evaluations() const { return evaluations_; }  // of the whole problem

  // Of the whole Hessian last asked for (n); empty before.
  const Vector& whole_diagonal() const { return whole_diagonal_; }

  int size() const override { return static_cast<int>(modes_.rows()); }
  double evaluate(const Vector& c, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& c, HessianModel model) override;  // P^T H P

 private:
  Problem& whole_;
  const SparseMatrix& modes_;
  const Vector origin_;
  Point point_;  // the last one asked for: a second run starts where the first one ended
  Vector c_;     // its coefficients
  int evaluations_ = 0;
  GalerkinProduct product_;
  Vector whole_diagonal_;
};

}  // namespace reflines
