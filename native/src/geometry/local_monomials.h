// Monomials around a triangle, by which stencils are made and judged.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines {

struct LocalMonomials {
  double size = 0.0;  // largest distance of a point from the triangle's centroid
  // 10 x #points: 1, x, y, x^2/2, xy, y^2/2, x^3/6, x^2y/2, xy^2/2, y^3/6 relative to the centroid, in units of `size`.
  Eigen::Matrix<double, 10, Eigen::Dynamic> value;
};

// Evaluates the monomials around triangle t at vertices of the field.
LocalMonomials local_monomials(const HeightField& field, int t, const std::vector<int>& vertex);

}  // namespace reflines
