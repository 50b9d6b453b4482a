// The polynomial of up to third degree that is nearest to scattered heights.
#pragma once

#include <limits>

#include "reflines/types.h"

namespace reflines {

using Vector4 = Eigen::Vector4d;

// The fit at the origin: height, slopes (f_x, f_y), second derivatives (f_xx, f_xy, f_yy).
struct HeightFit {
  int degree = 0;  // 3, or 2 where the points do not determine a cubic; 0: not even a quadratic
  double height = 0;
  Vector2 slope = Vector2::Zero();
  Vector3 second = Vector3::Zero();
  Vector4 third = Vector4::Zero();  // f_xxx, f_xxy, f_xyy, f_yyy
  // The standard errors of the second and third derivatives, by the residuals and the covariance of the least squares:
  // the root of the expected square of their error's norm as a tensor. Infinite where no residual is left, those of the
  // third ones also where the degree is 2.
  double second_error = std::numeric_limits<double>::infinity();
  double third_error = std::numeric_limits<double>::infinity();
};

// Fits heights (#P) over points (#P x 2) by least squares. The points should surround the origin or lie beside it.
HeightFit fit_heights(const PlanePositions& points, const Vector& heights);

}  // namespace reflines
