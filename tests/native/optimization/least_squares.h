// Textbook sums of squares with known minima, as the minimizer sees them: no mesh, at most three unknowns a residual.
#pragma once

#include <array>
#include <vector>

#include "optimization/problem.h"

namespace reflines {

// One residual r(a, b, c) of three unknowns, with its derivatives.
struct Residual {
  double value = 0.0;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

// E = sum r_i^2 over residuals of given unknowns; index -1 is the constant 0.
class LeastSquares : public Problem {
 public:
  LeastSquares(int size, std::vector<std::array<int, 3>> unknowns);

  int size() const override { return size_; }
  double evaluate(const Vector& x, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override;

 protected:
  virtual Residual residual(int index, const Eigen::Vector3d& values) const = 0;
  Eigen::Vector3d values_at(int index, const Vector& x) const;

 private:
  void add(int index, const Eigen::Matrix3d& block);

  int size_;
  std::vector<std::array<int, 3>> unknowns_;
  SparseMatrix hessian_;
};

// The pairs (steepness (b - a^2), 1 - a) of Rosenbrock: the minimum 0 at (1, ..., 1), at the end of a curved valley.
class Rosenbrock final : public LeastSquares {
 public:
  explicit Rosenbrock(int pairs, double steepness = 10.0);
  Vector start() const;

 private:
  Residual residual(int index, const Eigen::Vector3d& values) const override;

  double steepness_;
};

// A bent chain with held ends: second differences plus `bend` times the squared slope are to be what they are at
// `minimum`. bend = 0 makes it quadratic.
class Chain final : public LeastSquares {
 public:
  Chain(int size, double bend);
  void set_minimum(const Vector& minimum);
  Vector wave(double amplitude) const;  // a smooth choice of heights

 private:
  Residual residual(int index, const Eigen::Vector3d& values) const override;
  Residual shape(const Eigen::Vector3d& values) const;

  double bend_;
  Vector wanted_;
};

}  // namespace reflines
