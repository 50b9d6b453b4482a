#include "solver/quadrature.h"

namespace reflines {

Quadrature make_quadrature(const HeightField& field, const Vector& weight) {
  Quadrature result;
  for (int t = 0; t < field.triangle_count() && weight.size() > 0; ++t) {
    if (weight(field.source[t]) > 0) result.triangle.push_back(t);
  }
  result.weight.resize(result.triangle.size());
  for (int row = 0; row < result.weight.size(); ++row) {
    result.weight(row) = weight(field.source[result.triangle[row]]);
  }
  return result;
}

}  // namespace reflines
