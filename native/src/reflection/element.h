// The energy of one triangle as a function of its five derivatives u = (f_x, f_y, f_xx, f_xy, f_yy).
#pragma once

#include "geometry/derivatives.h"
#include "reflection/reflection_function.h"
#include "reflines/types.h"

namespace reflines {

using Matrix5 = Eigen::Matrix<double, 5, 5>;

// Returns grad theta of a triangle.
Vector2 theta_gradient(const ThetaDerivatives& d, const Vector5& u);

// Returns its 2 x 5 Jacobian with respect to u.
Eigen::Matrix<double, 2, 5> theta_gradient_jacobian(const ThetaDerivatives& d, const Vector5& u);

// Returns the energy of a gradient fit (eq. 4), weight |grad theta(u) - wanted|^2. Adds to `gradient` where it is not
// null.
double gradient_fit(const ReflectionFunction& reflection, const Vector5& u, const Vector2& wanted, double weight,
                    Vector5* gradient);

// Returns the energy of a value fit (eq. 3): weight ((cos theta - cos wanted)^2 + (sin theta - sin wanted)^2) = weight
// (2 - 2 cos(theta - wanted)).
double value_fit(const ReflectionFunction& reflection, const Vector5& u, double wanted, double weight,
                 Vector5* gradient);

// Return second-order models of the two fits. Gauss-Newton and linearised ones are positive semi-definite; the full
// Hessian (kNewton) is not, and is projected by the caller after the terms of a triangle are summed.
Matrix5 gradient_fit_hessian(const ReflectionFunction& reflection, const Vector5& u, const Vector2& wanted,
                             double weight, HessianModel model);
Matrix5 value_fit_hessian(const ReflectionFunction& reflection, const Vector5& u, double wanted, double weight,
                          HessianModel model);

}  // namespace reflines
