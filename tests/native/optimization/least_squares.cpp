#include "least_squares.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace reflines {

namespace {

std::vector<std::array<int, 3>> rosenbrock_unknowns(int pairs) {
  std::vector<std::array<int, 3>> unknowns;
  for (int pair = 0; pair < pairs; ++pair) {
    unknowns.push_back({2 * pair, 2 * pair + 1, -1});
    unknowns.push_back({2 * pair, -1, -1});
  }
  return unknowns;
}

std::vector<std::array<int, 3>> chain_unknowns(int size) {
  std::vector<std::array<int, 3>> unknowns;
  for (int k = 0; k < size; ++k) unknowns.push_back({k - 1, k, k + 1 < size ? k + 1 : -1});
  return unknowns;
}

Eigen::Matrix3d positive_part(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

LeastSquares::LeastSquares(int size, std::vector<std::array<int, 3>> unknowns)
    : size_(size), unknowns_(std::move(unknowns)), hessian_(size, size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& indices : unknowns_) {
    for (const int row : indices) {
      for (const int column : indices) {
        if (column >= 0 && row >= column) entries.emplace_back(row, column, 0.0);
      }
    }
  }
  hessian_.setFromTriplets(entries.begin(), entries.end());
}

Eigen::Vector3d LeastSquares::values_at(int index, const Vector& x) const {
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    if (unknowns_[index][k] >= 0) values[k] = x[unknowns_[index][k]];
  }
  return values;
}

double LeastSquares::evaluate(const Vector& x, Vector* gradient) {
  double energy = 0.0;
  if (gradient != nullptr) gradient->setZero();
  for (int index = 0; index < static_cast<int>(unknowns_.size()); ++index) {
    const Residual r = residual(index, values_at(index, x));
    energy += r.value * r.value;
    if (gradient == nullptr) continue;
    for (int k = 0; k < 3; ++k) {
      if (unknowns_[index][k] >= 0) (*gradient)[unknowns_[index][k]] += 2.0 * r.value * r.gradient[k];
    }
  }
  return energy;
}

const SparseMatrix& LeastSquares::hessian(const Vector& x, HessianModel model) {
  hessian_.coeffs().setZero();
  const Vector flat = Vector::Zero(size_);
  for (int index = 0; index < static_cast<int>(unknowns_.size()); ++index) {
    const Residual r = residual(index, values_at(index, model == HessianModel::kLinearized ? flat : x));
    const Eigen::Matrix3d gauss_newton = 2.0 * r.gradient * r.gradient.transpose();
    add(index, model == HessianModel::kNewton ? positive_part(gauss_newton + 2.0 * r.value * r.second) : gauss_newton);
  }
  return hessian_;
}

void LeastSquares::add(int index, const Eigen::Matrix3d& block) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int row = unknowns_[index][i], column = unknowns_[index][j];
      if (column >= 0 && row >= column) hessian_.coeffRef(row, column) += block(i, j);
    }
  }
}

Rosenbrock::Rosenbrock(int pairs, double steepness)
    : LeastSquares(2 * pairs, rosenbrock_unknowns(pairs)), steepness_(steepness) {}

Vector Rosenbrock::start() const {
  Vector x(size());
  for (int k = 0; k < size(); ++k) x[k] = k % 2 == 0 ? -1.2 : 1.0;
  return x;
}

Residual Rosenbrock::residual(int index, const Eigen::Vector3d& values) const {
  Residual r;
  if (index % 2 == 1) {
    r.value = 1.0 - values[0];
    r.gradient[0] = -1.0;
    return r;
  }
  r.value = steepness_ * (values[1] - values[0] * values[0]);
  r.gradient << -2.0 * steepness_ * values[0], steepness_, 0.0;
  r.second(0, 0) = -2.0 * steepness_;
  return r;
}

Chain::Chain(int size, double bend)
    : LeastSquares(size, chain_unknowns(size)), bend_(bend), wanted_(Vector::Zero(size)) {}

Vector Chain::wave(double amplitude) const {
  Vector x(size());
  for (int k = 0; k < size(); ++k) x[k] = amplitude * std::sin(3.0 * k / size()) * std::cos(7.0 * k / size());
  return x;
}

void Chain::set_minimum(const Vector& minimum) {
  for (int k = 0; k < size(); ++k) wanted_[k] = shape(values_at(k, minimum)).value;
}

Residual Chain::shape(const Eigen::Vector3d& values) const {
  Residual r;
  const double slope = values[2] - values[0];
  r.value = values[0] - 2.0 * values[1] + values[2] + bend_ * slope * slope;
  r.gradient << 1.0 - 2.0 * bend_ * slope, -2.0, 1.0 + 2.0 * bend_ * slope;
  r.second << 2.0 * bend_, 0.0, -2.0 * bend_, 0.0, 0.0, 0.0, -2.0 * bend_, 0.0, 2.0 * bend_;
  return r;
}

Residual Chain::residual(int index, const Eigen::Vector3d& values) const {
  Residual r = shape(values);
  r.value -= wanted_[index];
  return r;
}

}  // namespace reflines
