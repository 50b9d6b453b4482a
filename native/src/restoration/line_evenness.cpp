#include "restoration/line_evenness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reflection/line_comparison.h"
#include "reflection/reflection_function.h"

namespace reflines {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Radians that count of an offset at most: beyond, lines have no course. On triangles seen at a grazing angle gradients
// are of any size: on a coarse bonnet one such triangle made a root mean square of 357 degrees.
constexpr double kFarthest = std::numbers::pi / 4.0;

// Returns the root mean square over each triangle (#F) of what is `off` in its middle and changes by `gradient` (#F x
// 2) from there: the mean over a triangle of (g . (p - c))^2 is a 36th of the sum over its edges e of (g . e)^2. By the
// middles alone waves of five cells count 12 % less than the same on a fine mesh.
Vector spread_over_triangles(const Vector& off, const PlaneVectors& gradient, const PlanePositions& xy,
                             const Triangles& F) {
  Vector result(off.size());
  for (Eigen::Index t = 0; t < off.size(); ++t) {
    double squares = 0;
    for (int i = 0; i < 3; ++i) {
      const double along = gradient.row(t).dot(xy.row(F(t, (i + 1) % 3)) - xy.row(F(t, i)));
      squares += along * along;
    }
    result(t) = std::sqrt(off(t) * off(t) + squares / 36.0);
  }
  return result;
}

Vector compare(const ShapeOptimizer::Lines& lines, const ShapeOptimizer::Lines& course, ControlledSurface& surface) {
  const Vector middle = (lines.theta - course.theta).unaryExpr([](double angle) { return wrap_angle(angle); });
  return spread_over_triangles(middle, lines.target.gradient - course.target.gradient, surface.optimizer().xy(),
                               surface.triangles())
      .cwiseMin(kFarthest);
}

}  // namespace

Vector measure_offsets(ControlledSurface& surface, const Vector& z, const Vector& course, int family) {
  ShapeOptimizer& optimizer = surface.optimizer();
  const Vector known = Vector::Ones(z.size());
  return compare(optimizer.evaluate_lines(z, known, family), optimizer.evaluate_lines(course, known, family), surface);
}

Unevenness measure_unevenness(ControlledSurface& surface, const Vector& z, const Vector& smoothed, double length) {
  ShapeOptimizer& optimizer = surface.optimizer();
  const Vector known = Vector::Ones(z.size()), area = optimizer.area();
  const double whole = area.sum();
  Unevenness result;
  result.squares.resize(area.size(), optimizer.family_count());
  for (int k = 0; k < optimizer.family_count(); ++k) {
    const ShapeOptimizer::Lines lines = optimizer.evaluate_lines(z, known, k);
    const ShapeOptimizer::Lines course = optimizer.evaluate_lines(smoothed, known, k);
    const Vector off = compare(lines, course, surface), seen = area.cwiseProduct(optimizer.sight(k));
    result.squares.col(k) = optimizer.sight(k).cwiseProduct((kDegrees * off).cwiseAbs2());
    const double sum = std::max(seen.sum(), 1e-300);
    result.seen.push_back(seen.sum() / whole);
    result.degrees.push_back(kDegrees * std::sqrt(seen.dot(off.cwiseAbs2()) / sum));
    LineScore score = compare_lines(lines.target.gradient, course.target.gradient, seen, length).score();
    score.shift = kDegrees * seen.dot(off) / sum;
    result.score.push_back(score);
    if (k == 0) result.line_deviation = surface.gather_faces(off / length);
  }
  return result;
}

}  // namespace reflines
