#include "reflines/uniform_target.h"

#include <algorithm>
#include <cmath>

#include "reflines/errors.h"

namespace reflines {
namespace {

void check_influence(const RegionField& field, const Vector& influence) {
  if (influence.size() == 0) return;
  if (influence.size() != field.F.rows()) {
    throw InvalidInput("There are " + std::to_string(influence.size()) + " influences for " +
                       std::to_string(field.F.rows()) + " triangles; give one each, or none.");
  }
  if (influence.allFinite() && influence.minCoeff() >= 0 && influence.maxCoeff() <= 1) return;
  throw InvalidInput("An influence lies outside 0 to 1; check the fall-off curve.");
}

double read_influence(const RegionField& field, const Vector& influence, int t) {
  return field.response(t) * (influence.size() == 0 ? 1.0 : influence(t));
}

void check_density(double density, double density_end, const Vector2& axis) {
  if (!(density >= 0) || !std::isfinite(density)) {
    throw InvalidInput("The density of the lines must be zero or positive.");
  }
  if (!std::isfinite(density_end) || !axis.allFinite()) {
    throw InvalidInput("The density at the end or the axis is not a finite number; type it again.");
  }
}

// Returns the position of each triangle along the axis, 0 at the region's first and 1 at its last.
Vector measure_along_axis(const RegionField& field, const Vector2& axis) {
  Vector position = field.center * axis;
  double low = INFINITY, high = -INFINITY;
  for (int t = 0; t < position.size(); ++t) {
    if (!field.active(t)) continue;
    low = std::min(low, position(t));
    high = std::max(high, position(t));
  }
  if (!(high > low)) return Vector::Zero(position.size());
  return ((position.array() - low) / (high - low)).matrix();
}

// Returns the density of each triangle, which goes linearly to `end` along the axis; a negative end is `density`.
Vector read_densities(const RegionField& field, double density, double end, const Vector2& axis) {
  const double change = end < 0 ? 0 : end - density;
  return (density + measure_along_axis(field, axis).array() * change).matrix();
}

}  // namespace

Target build_uniform_target(const RegionField& field, const UniformOptions& options, const Vector& influence) {
  check_influence(field, influence);
  check_density(options.density, options.density_end, options.axis);
  if (!options.direction.allFinite()) throw InvalidInput("The direction is not a finite number; type it again.");
  const Vector2 median = field.median_gradient();
  const bool own_direction = options.direction.norm() == 0;
  Vector2 across = own_direction ? median : Vector2(-options.direction.y(), options.direction.x());
  if (across.norm() == 0) throw InvalidInput("The region's lines have no median direction; give the direction.");
  across.normalize();
  if (across.dot(median) < 0) across = -across;
  const double unit = options.relative ? median.norm() : 1.0;
  const Vector density = read_densities(field, options.density, options.density_end, options.axis);
  Target target{field.gradient, {}, {}, field.family, true};
  for (int t = 0; t < field.F.rows(); ++t) {
    const Eigen::RowVector2d now = field.gradient.row(t);
    target.gradient.row(t) += read_influence(field, influence, t) * (unit * density(t) * across.transpose() - now);
  }
  return target;
}

Target build_turned_target(const RegionField& field, const TurnOptions& options, const Vector& influence) {
  check_influence(field, influence);
  check_density(options.density, options.density_end, options.axis);
  if (!std::isfinite(options.angle)) throw InvalidInput("The angle is not a number; give radians.");
  const Vector density = read_densities(field, options.density, options.density_end, options.axis);
  Target target{field.gradient, {}, {}, field.family, true};
  for (int t = 0; t < field.F.rows(); ++t) {
    const double fraction = read_influence(field, influence, t), own = options.angle * fraction;
    const double factor = 1 + fraction * (density(t) - 1);
    if (own == 0 && factor == 1) continue;
    const double x = factor * field.gradient(t, 0), y = factor * field.gradient(t, 1);
    target.gradient.row(t) << std::cos(own) * x - std::sin(own) * y, std::sin(own) * x + std::cos(own) * y;
  }
  return target;
}

Vector falloff(const RegionField& field, const Vector2& centre, double radius, const Vector& curve) {
  if (!(radius > 0)) throw InvalidInput("The fall-off radius must be positive.");
  if (!std::isfinite(radius) || !centre.allFinite() || !curve.allFinite()) {
    throw InvalidInput("The fall-off's centre, radius or curve is not finite; place it again.");
  }
  if (curve.size() < 2) throw InvalidInput("A fall-off curve needs at least two values.");
  const int last = static_cast<int>(curve.size()) - 1;
  Vector result(field.F.rows());
  for (int t = 0; t < field.F.rows(); ++t) {
    const double position = std::min(1.0, (field.center.row(t).transpose() - centre).norm() / radius) * last;
    const int step = std::min(static_cast<int>(position), last - 1);
    result(t) = curve(step) + (position - step) * (curve(step + 1) - curve(step));
  }
  return result;
}

}  // namespace reflines
