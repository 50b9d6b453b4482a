#include "restoration/line_fields.h"

#include <cstddef>

namespace reflines {

TriangleFields read_fields(ShapeOptimizer& optimizer, const Vector& z) {
  TriangleFields result(optimizer.triangle_count(), 2 * optimizer.family_count());
  const Vector known = Vector::Ones(z.size());
  for (int k = 0; k < optimizer.family_count(); ++k)
    result.middleCols(2 * k, 2) = optimizer.evaluate_lines(z, known, k).target.gradient;
  return result;
}

std::vector<Target> make_targets(const TriangleFields& fields, const std::vector<double>& weight) {
  std::vector<Target> result(fields.cols() / 2);
  for (size_t k = 0; k < result.size(); ++k) {
    result[k].gradient = fields.middleCols(2 * static_cast<Eigen::Index>(k), 2);
    result[k].family = static_cast<int>(k);
    if (!weight.empty()) result[k].weight = Vector::Constant(fields.rows(), weight[k]);
  }
  return result;
}

}  // namespace reflines
