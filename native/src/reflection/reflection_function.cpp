#include "reflection/reflection_function.h"

#include <cmath>
#include <numbers>

namespace reflines {
namespace {

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

// Returns the argument in (-pi, pi]: with an imaginary part of -0 atan2 would give -pi.
double angle_of(const std::complex<double>& w) { return std::atan2(w.imag() + 0.0, w.real()); }

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

double ReflectionFunction::theta(double p, double q) const { return angle_of(w(p, q)); }

double ReflectionFunction::theta(const Vector3& normal) const {
  const Vector3 n = normal.stableNormalized();
  return angle_of(n.z() * n.z() * c0_ - n.z() * (n.x() * cp_ + n.y() * cq_) + n.x() * n.x() * cpp_ +
                  n.x() * n.y() * cpq_ + n.y() * n.y() * cqq_);
}

double ReflectionFunction::visibility(double p, double q) const {
  return std::sqrt(std::norm(w(p, q))) / (1 + p * p + q * q);
}

}  // namespace reflines
