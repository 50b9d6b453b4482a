#include "reflection/reflection_function.h"

#include <cmath>
#include <numbers>

namespace reflines {
namespace {

using Complex = std::complex<double>;

// The smallest |w| / |N|^2 (the visibility) at which derivatives are evaluated; the energy gives such triangles no
// weight.
constexpr double kSmallestVisibility = 1e-6;

// The coefficients of 2 (N.b)(N.c) - (b.c) N.N for N = (-p, -q, 1): |N|^2 times the component along c of b reflected in
// N.
struct Quadratic {
  double c0, cp, cq, cpp, cpq, cqq;
};

Quadratic reflected_component(const Vector3& b, const Vector3& c) {
  const double dot = b.dot(c);
  return {2 * b.z() * c.z() - dot, -2 * (b.x() * c.z() + b.z() * c.x()), -2 * (b.y() * c.z() + b.z() * c.y()),
          2 * b.x() * c.x() - dot, 2 * (b.x() * c.y() + b.y() * c.x()),  2 * b.y() * c.y() - dot};
}

}  // namespace

double wrap_angle(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

ReflectionFunction::ReflectionFunction(const ImagePlane& frame, const Vector3& view_direction,
                                       const Vector3& line_direction) {
  const ImagePlane own(view_direction, line_direction);
  const Vector3 a = line_direction.stableNormalized();
  const Vector3 v_a = (own.z() - own.z().dot(a) * a).normalized();
  const Vector3 view = frame.to_frame(own.z());
  const Quadratic r1 = reflected_component(view, frame.to_frame(own.x()));
  const Quadratic r2 = reflected_component(view, frame.to_frame(v_a));
  c0_ = {r2.c0, r1.c0};
  cp_ = {r2.cp, r1.cp};
  cq_ = {r2.cq, r1.cq};
  cpp_ = {r2.cpp, r1.cpp};
  cpq_ = {r2.cpq, r1.cpq};
  cqq_ = {r2.cqq, r1.cqq};
}

Complex ReflectionFunction::w(double p, double q) const {
  return c0_ + p * (cp_ + p * cpp_ + q * cpq_) + q * (cq_ + q * cqq_);
}

double ReflectionFunction::theta(double p, double q) const {
  const Complex value = w(p, q);
  return std::atan2(value.imag(), value.real());
}

double ReflectionFunction::visibility(double p, double q) const {
  return std::sqrt(std::norm(w(p, q))) / (1 + p * p + q * q);
}

ThetaDerivatives ReflectionFunction::derivatives(double p, double q, int order) const {
  Complex value = w(p, q);
  const double floor = kSmallestVisibility * (1 + p * p + q * q);
  if (std::norm(value) < floor * floor) value = floor;
  const double scale = 1.0 / std::norm(value);
  const Complex inverse(value.real() * scale, -value.imag() * scale);
  const Complex P = (cp_ + 2 * p * cpp_ + q * cpq_) * inverse, Q = (cq_ + p * cpq_ + 2 * q * cqq_) * inverse;
  ThetaDerivatives d;
  d.p = P.imag();
  d.q = Q.imag();
  if (order < 2) return d;
  const Complex A = 2.0 * cpp_ * inverse, B = cpq_ * inverse, C = 2.0 * cqq_ * inverse;
  const Complex PP = A - P * P, PQ = B - P * Q, QQ = C - Q * Q;  // second derivatives of log w
  d.pp = PP.imag();
  d.pq = PQ.imag();
  d.qq = QQ.imag();
  if (order < 3) return d;
  // (log w)_ijk = -w_ij w_k / w^2 - L_ik L_j - L_i L_jk, since w is quadratic.
  d.ppp = (-A * P - 2.0 * PP * P).imag();
  d.ppq = (-A * Q - 2.0 * PQ * P).imag();
  d.pqq = (-C * P - 2.0 * PQ * Q).imag();
  d.qqq = (-C * Q - 2.0 * QQ * Q).imag();
  return d;
}

}  // namespace reflines
