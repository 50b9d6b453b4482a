#include "reflection/element.h"

#include <cmath>

namespace reflines {
namespace {

// Returns the derivatives at slopes zero: the linearised reflection function of the paper, theta ~ theta_p f_x +
// theta_q f_y with constant factors.
ThetaDerivatives linearize(const ReflectionFunction& reflection) { return reflection.derivatives(0, 0, 1); }

// Returns sum_k residual_k times the second derivatives of (grad theta)_k with respect to u.
Matrix5 compute_curvature(const ThetaDerivatives& d, const Vector5& u, const Vector2& residual) {
  const double xx = u(2), xy = u(3), yy = u(4), r = residual.x(), s = residual.y();
  Matrix5 C = Matrix5::Zero();
  C(0, 0) = r * (d.ppp * xx + d.ppq * xy) + s * (d.ppp * xy + d.ppq * yy);
  C(0, 1) = r * (d.ppq * xx + d.pqq * xy) + s * (d.ppq * xy + d.pqq * yy);
  C(1, 1) = r * (d.pqq * xx + d.qqq * xy) + s * (d.pqq * xy + d.qqq * yy);
  C(0, 2) = r * d.pp;
  C(0, 3) = r * d.pq + s * d.pp;
  C(0, 4) = s * d.pq;
  C(1, 2) = r * d.pq;
  C(1, 3) = r * d.qq + s * d.pq;
  C(1, 4) = s * d.qq;
  return C.selfadjointView<Eigen::Upper>();
}

// Returns J^T v for the Jacobian below, without the zeros that are a third of it.
Vector5 jacobian_transposed_times(const ThetaDerivatives& d, const Vector5& u, const Vector2& v) {
  const double xx = v.x() * u(2) + v.y() * u(3), xy = v.x() * u(3) + v.y() * u(4);
  return {d.pp * xx + d.pq * xy, d.pq * xx + d.qq * xy, d.p * v.x(), d.q * v.x() + d.p * v.y(), d.q * v.y()};
}

}  // namespace

Vector2 theta_gradient(const ThetaDerivatives& d, const Vector5& u) {
  return {d.p * u(2) + d.q * u(3), d.p * u(3) + d.q * u(4)};
}

Eigen::Matrix<double, 2, 5> theta_gradient_jacobian(const ThetaDerivatives& d, const Vector5& u) {
  Eigen::Matrix<double, 2, 5> J;
  J << d.pp * u(2) + d.pq * u(3), d.pq * u(2) + d.qq * u(3), d.p, d.q, 0,  //
      d.pp * u(3) + d.pq * u(4), d.pq * u(3) + d.qq * u(4), 0, d.p, d.q;
  return J;
}

double gradient_fit(const ReflectionFunction& reflection, const Vector5& u, const Vector2& wanted, double weight,
                    Vector5* gradient) {
  const ThetaDerivatives d = reflection.derivatives(u(0), u(1), gradient ? 2 : 1);
  const Vector2 residual = theta_gradient(d, u) - wanted;
  if (gradient) *gradient += 2 * weight * jacobian_transposed_times(d, u, residual);
  return weight * residual.squaredNorm();
}

double value_fit(const ReflectionFunction& reflection, const Vector5& u, double wanted, double weight,
                 Vector5* gradient) {
  const double half = 0.5 * (reflection.theta(u(0), u(1)) - wanted);
  if (gradient) {
    const ThetaDerivatives d = reflection.derivatives(u(0), u(1), 1);
    gradient->head<2>() += 2 * weight * std::sin(2 * half) * Vector2(d.p, d.q);
  }
  return 4 * weight * std::sin(half) * std::sin(half);  // 2 - 2 cos, without its cancellation near a perfect fit
}

Matrix5 gradient_fit_hessian(const ReflectionFunction& reflection, const Vector5& u, const Vector2& wanted,
                             double weight, HessianModel model) {
  if (model == HessianModel::kLinearized) {
    const Eigen::Matrix<double, 2, 5> J = theta_gradient_jacobian(linearize(reflection), u);
    return 2 * weight * J.transpose() * J;
  }
  const ThetaDerivatives d = reflection.derivatives(u(0), u(1), model == HessianModel::kNewton ? 3 : 2);
  const Eigen::Matrix<double, 2, 5> J = theta_gradient_jacobian(d, u);
  Matrix5 M = J.transpose() * J;
  if (model == HessianModel::kNewton) M += compute_curvature(d, u, theta_gradient(d, u) - wanted);
  return 2 * weight * M;
}

Matrix5 value_fit_hessian(const ReflectionFunction& reflection, const Vector5& u, double wanted, double weight,
                          HessianModel model) {
  const bool newton = model == HessianModel::kNewton;
  const ThetaDerivatives d =
      model == HessianModel::kLinearized ? linearize(reflection) : reflection.derivatives(u(0), u(1), newton ? 2 : 1);
  const double difference = newton ? reflection.theta(u(0), u(1)) - wanted : 0.0;
  const Vector2 slope(d.p, d.q);
  Eigen::Matrix2d second;
  second << d.pp, d.pq, d.pq, d.qq;
  Matrix5 M = Matrix5::Zero();
  M.topLeftCorner<2, 2>() = std::cos(difference) * slope * slope.transpose() + std::sin(difference) * second;
  return 2 * weight * M;
}

}  // namespace reflines
