#include "reflection/reflection_field.h"

#include <cmath>

#include "reflection/element.h"

namespace reflines {
namespace {

constexpr double kFullVisibility = 0.05;

double visibility_weight(double visibility) {
  const double fraction = visibility / kFullVisibility;
  return fraction >= 1 ? 1.0 : fraction * fraction;
}

}  // namespace

ReflectionField reflection_field(const ReflectionFunction& reflection, const TriangleDerivatives& u) {
  ReflectionField field{Vector(u.rows()), PlaneVectors(u.rows(), 2)};
#pragma omp parallel for schedule(static) if (u.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(u.rows()); ++t) {
    field.theta(t) = reflection.theta(u(t, 0), u(t, 1));
    field.gradient.row(t) = theta_gradient(reflection.derivatives(u(t, 0), u(t, 1), 1), u.row(t));
  }
  return field;
}

PlaneVectors gradient_field(const ReflectionFunction& reflection, const TriangleDerivatives& u) {
  PlaneVectors gradient(u.rows(), 2);
#pragma omp parallel for schedule(static) if (u.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(u.rows()); ++t) {
    gradient.row(t) = theta_gradient(reflection.derivatives(u(t, 0), u(t, 1), 1), u.row(t));
  }
  return gradient;
}

Vector visibility_weights(const ReflectionFunction& reflection, const TriangleDerivatives& u) {
  Vector weight(u.rows());
#pragma omp parallel for schedule(static) if (u.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(u.rows()); ++t) {
    weight(t) = visibility_weight(reflection.visibility(u(t, 0), u(t, 1)));
  }
  return weight;
}

}  // namespace reflines
