// The polynomial of up to third degree that is nearest to scattered heights.
#pragma once

#include "reflines/types.h"

namespace reflines {

// The fit at the origin: height, slopes (f_x, f_y), second derivatives (f_xx, f_xy, f_yy).
struct HeightFit {
  int degree = 0;  // 3, or 2 where the points do not determine a cubic; 0: not even a quadratic
  double height = 0;
  Vector2 slope = Vector2::Zero();
  Vector3 second = Vector3::Zero();
};

// Fits heights (#P) over points (#P x 2) by least squares. The points should surround the origin or lie beside it.
HeightFit fit_heights(const PlanePositions& points, const Vector& heights);

}  // namespace reflines
