#include "native/reflection/field.h"

#include "native/reflection/element.h"

namespace reflines {

ReflectionField reflection_field(const ReflectionFunction& reflection, const TriangleDerivatives& u) {
  ReflectionField field;
  field.theta.resize(u.rows());
  field.gradient.resize(u.rows(), 2);
  field.visibility.resize(u.rows());
#pragma omp parallel for schedule(static) if (u.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(u.rows()); ++t) {
    field.theta(t) = reflection.theta(u(t, 0), u(t, 1));
    field.gradient.row(t) = theta_gradient(reflection.derivatives(u(t, 0), u(t, 1), 1), u.row(t));
    field.visibility(t) = reflection.visibility(u(t, 0), u(t, 1));
  }
  return field;
}

double visibility_weight(double visibility) {
  constexpr double kFull = 0.05;
  const double share = visibility / kFull;
  return share >= 1 ? 1.0 : share * share;
}

}  // namespace reflines
