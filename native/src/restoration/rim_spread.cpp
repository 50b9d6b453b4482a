#include "restoration/rim_spread.h"

#include <algorithm>
#include <cmath>

#include "geometry/nearest_surface.h"

namespace reflines {

double fade(double r) { return r < 1 ? std::pow(1 - r * r, 3) : 0.0; }

Vector spread_from_rim(const PlanePositions& points, const Triangles& edges, const Vector& values, double width,
                       const std::function<double(double distance)>& course) {
  Positions flat = Positions::Zero(points.rows(), 3);
  flat.leftCols<2>() = points;
  const NearestSurface rim(flat, edges);
  Vector result = Vector::Zero(points.rows());
#pragma omp parallel for schedule(static) if (result.size() > kWorthThreads)
  for (Eigen::Index v = 0; v < result.size(); ++v) {
    const Vector3 p = flat.row(v);
    const NearestPoint nearest = rim.find(p, width);
    if (nearest.triangle < 0) continue;
    const int a = edges(nearest.triangle, 0), b = edges(nearest.triangle, 1);
    const Vector3 first = flat.row(a), second = flat.row(b);
    const double fraction = (nearest.point - first).norm() / std::max((second - first).norm(), 1e-300);
    result(v) = ((1 - fraction) * values(a) + fraction * values(b)) * course((nearest.point - p).norm());
  }
  return result;
}

}  // namespace reflines
