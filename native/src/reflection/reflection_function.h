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

  // Returns the sine of the angle between the reflected ray and the lines, in [0, 1]: theta is undefined where it is 0.
  double visibility(double p, double q) const;

  // Returns derivatives up to `order` (1, 2 or 3); higher ones are zero. Finite everywhere: |w| is bounded away from
  // zero.
  ThetaDerivatives derivatives(double p, double q, int order) const;

 private:
  std::complex<double> w(double p, double q) const;

  // The coefficients of w = c0 + cp p + cq q + cpp p^2 + cpq p q + cqq q^2.
  std::complex<double> c0_, cp_, cq_, cpp_, cpq_, cqq_;
};

}  // namespace reflines
