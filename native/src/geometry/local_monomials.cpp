#include "geometry/local_monomials.h"

#include <algorithm>

#include "geometry/centroids.h"

namespace reflines {

LocalMonomials local_monomials(const HeightField& field, int t, const std::vector<int>& vertex) {
  const auto at = [&field](int v) -> Vector2 { return field.xy.row(v); };
  const Vector2 centre = find_centroid(field.xy, field.F, t);
  LocalMonomials result;
  for (const int v : vertex) result.size = std::max(result.size, (at(v) - centre).norm());
  result.value.resize(10, static_cast<Eigen::Index>(vertex.size()));
  for (size_t k = 0; k < vertex.size(); ++k) {
    const Vector2 p = (at(vertex[k]) - centre) / result.size;
    const double x = p.x(), y = p.y();
    result.value.col(static_cast<Eigen::Index>(k)) << 1.0, x, y, x * x / 2, x * y, y * y / 2, x * x * x / 6,
        x * x * y / 2, x * y * y / 2, y * y * y / 6;
  }
  return result;
}

}  // namespace reflines
