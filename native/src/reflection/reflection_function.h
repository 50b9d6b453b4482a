// The reflection function theta: the light line that a point with slopes (p, q) = (f_x, f_y) reflects to the viewer
// (paper, section 2.1).
//
// With N = (-p, -q, 1) and d the projection of the reflected direction onto the plane perpendicular to the lines, r1 =
// d.a_perp and r2 = d.v_a are quadratic in (p, q), so theta = arg w with w = r2 + i r1 a complex quadratic polynomial,
// and every derivative of theta is the imaginary part of a derivative of log w: no branch cut, no atan in the solver.
#pragma once

#include <complex>

#include "reflines/image_plane.h"
#include "reflines/types.h"

namespace reflines {

// The derivatives of theta with respect to the slopes.
struct ThetaDerivatives {
  double p = 0, q = 0;                        // first
  double pp = 0, pq = 0, qq = 0;              // second
  double ppp = 0, ppq = 0, pqq = 0, qqq = 0;  // third
};

// Wraps a difference of two values of theta to [-pi, pi].
double wrap_angle(double angle);

class ReflectionFunction {
 public:
  // Takes slopes in `frame`; view and line direction are in world coordinates and need not be those of the frame
  // (several families use the heights of one frame). Throws InvalidInput where the two are parallel.
  ReflectionFunction(const ImagePlane& frame, const Vector3& view_direction, const Vector3& line_direction);

  double theta(double p, double q) const;  // radians in (-pi, pi]

  // Returns theta of a normal in the frame, of any length but 0; pi where it is perpendicular to the view.
  double theta(const Vector3& normal) const;

  // Returns the sine of the angle between the reflected ray and the lines, in [0, 1]: theta is undefined where it is 0.
  double visibility(double p, double q) const;

  // Returns derivatives up to `order` (1, 2 or 3); higher ones are zero. Finite everywhere: |w| is bounded away from
  // zero.
  ThetaDerivatives derivatives(double p, double q, int order) const;

 private:
  using Complex = std::complex<double>;

  // Returns the product without operator*'s test for numbers that are none: with the same bits in half of the time.
  static Complex multiply(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
  }

  Complex w(double p, double q) const { return c0_ + p * (cp_ + p * cpp_ + q * cpq_) + q * (cq_ + q * cqq_); }

  // The smallest |w| / |N|^2 (the visibility) at which derivatives are evaluated; the energy gives such triangles no
  // weight.
  static constexpr double kSmallestVisibility = 1e-6;

  // The coefficients of w = c0 + cp p + cq q + cpp p^2 + cpq p q + cqq q^2.
  Complex c0_, cp_, cq_, cpp_, cpq_, cqq_;
};

// Computes the derivatives inline, since an evaluation of the energy takes a third of its time here.
inline ThetaDerivatives ReflectionFunction::derivatives(double p, double q, int order) const {
  Complex value = w(p, q);
  const double floor = kSmallestVisibility * (1 + p * p + q * q);
  if (std::norm(value) < floor * floor) value = floor;
  const double scale = 1.0 / std::norm(value);
  const Complex inverse(value.real() * scale, -value.imag() * scale);
  const Complex P = multiply(cp_ + 2 * p * cpp_ + q * cpq_, inverse),
                Q = multiply(cq_ + p * cpq_ + 2 * q * cqq_, inverse);
  ThetaDerivatives d;
  d.p = P.imag();
  d.q = Q.imag();
  if (order < 2) return d;
  const Complex A = multiply(2.0 * cpp_, inverse), B = multiply(cpq_, inverse), C = multiply(2.0 * cqq_, inverse);
  // Second derivatives of log w.
  const Complex PP = A - multiply(P, P), PQ = B - multiply(P, Q), QQ = C - multiply(Q, Q);
  d.pp = PP.imag();
  d.pq = PQ.imag();
  d.qq = QQ.imag();
  if (order < 3) return d;
  // (log w)_ijk = -w_ij w_k / w^2 - L_ik L_j - L_i L_jk, since w is quadratic.
  d.ppp = (multiply(-A, P) - multiply(2.0 * PP, P)).imag();
  d.ppq = (multiply(-A, Q) - multiply(2.0 * PQ, P)).imag();
  d.pqq = (multiply(-C, P) - multiply(2.0 * PQ, Q)).imag();
  d.qqq = (multiply(-C, Q) - multiply(2.0 * QQ, Q)).imag();
  return d;
}

}  // namespace reflines
