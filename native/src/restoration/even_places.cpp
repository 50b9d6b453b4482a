#include "restoration/even_places.h"

#include <algorithm>

#include "base/smoothstep.h"
#include "restoration/disk_mean.h"
#include "restoration/press_rules.h"

namespace reflines {
namespace {

// Returns the same for each triangle (#F).
Vector find_even_triangles(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after, double raised) {
  const double nothing = kRules.visible * kRules.visible;
  Vector result(before.rows());
  for (Eigen::Index t = 0; t < result.size(); ++t) {
    double rise = 0;
    for (Eigen::Index k = 0; k < before.cols(); ++k)
      rise = std::max(rise, (after(t, k) - before(t, k)) / (before(t, k) + nothing));
    result(t) = 1.0 - smoothstep(0.0, raised, rise);
  }
  return result;
}

// Returns the means of `values` (#F) over disks around the vertices (#V).
Vector average_around(const ControlledSurface& surface, const Vector& values, const Vector& area,
                      const PlanePositions& xy, double radius) {
  Vector sum = Vector::Zero(xy.rows()), weight = Vector::Zero(xy.rows());
  for (Eigen::Index t = 0; t < values.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      sum(surface.triangles()(t, i)) += area(t) * values(t);
      weight(surface.triangles()(t, i)) += area(t);
    }
  }
  return DiskMean(xy, weight, radius).of(sum.cwiseQuotient(weight.cwiseMax(1e-300)));
}

}  // namespace

Vector find_even_places(ControlledSurface& surface, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
                        double length, double raised, const IndexVector& partner) {
  const double radius = kRules.verdict.even_radius * length;
  const Vector area = surface.optimizer().area();
  const PlanePositions xy = surface.optimizer().xy();
  const DiskMean around(surface.optimizer().centers(), area, radius);
  const Vector even = find_even_triangles(around.of_columns(before), around.of_columns(after), raised);
  const Vector own = average_around(surface, even, area, xy, radius);
  Vector result = own;
  for (Eigen::Index v = 0; v < partner.size(); ++v) {
    if (partner(v) >= 0) result(v) = std::min(own(v), own(partner(v)));
  }
  return result;
}

}  // namespace reflines
