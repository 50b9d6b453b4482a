#include "reflection/line_comparison.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reflines {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kLargestShift = 45.0;  // degrees

double angle_between(const Vector2& a, const Vector2& b) {
  return std::atan2(std::abs(a.x() * b.y() - a.y() * b.x()), a.dot(b));
}

}  // namespace

LineSums& LineSums::operator+=(const LineSums& other) {
  shift += other.shift;
  area += other.area;
  turn += other.turn;
  drawn += other.drawn;
  return *this;
}

LineScore LineSums::score() const { return {area > 0 ? shift / area : 0.0, drawn > 0 ? turn / drawn : 0.0}; }

LineSums compare_lines(const PlaneVectors& g, const PlaneVectors& course, const Vector& weight, double length) {
  LineSums sum;
  for (Eigen::Index t = 0; t < g.rows(); ++t) {
    if (!(weight(t) > 0)) continue;
    const Vector2 own = g.row(t), smooth = course.row(t);
    const double drawn = weight(t) * smooth.norm();
    sum.shift += weight(t) * std::min((own - smooth).norm() * length * kDegrees, kLargestShift);
    sum.turn += drawn * angle_between(own, smooth) * kDegrees;
    sum.area += weight(t);
    sum.drawn += drawn;
  }
  return sum;
}

}  // namespace reflines
