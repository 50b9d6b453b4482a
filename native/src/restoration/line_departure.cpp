#include "restoration/line_departure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/smoothstep.h"

namespace reflines {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Degrees that count of a deviation at most: beyond, lines have no course.
constexpr double kFarthest = 45.0;

// The sine of the angle between reflected ray and light lines: theta turns fast, and counts less, below the second.
constexpr double kUndefined = 0.05, kDefined = 0.2;

}  // namespace

Vector measure_departure(const ReflectionFunction& light, const PlaneVectors& slopes, const PlaneVectors& course,
                         const Vector& sight) {
  Vector result(slopes.rows());
#pragma omp parallel for schedule(static) if (slopes.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(slopes.rows()); ++t) {
    const double p = slopes(t, 0), q = slopes(t, 1), p0 = course(t, 0), q0 = course(t, 1);
    const double visibility = std::min(light.visibility(p, q), light.visibility(p0, q0));
    const double off = kDegrees * std::abs(wrap_angle(light.theta(p, q) - light.theta(p0, q0)));
    const double counted = smoothstep(kUndefined, kDefined, visibility) * std::min(off, kFarthest);
    result(t) = sight(t) > 0 ? sight(t) * counted * counted : 0.0;
  }
  return result;
}

}  // namespace reflines
