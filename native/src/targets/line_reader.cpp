#include "targets/line_reader.h"

#include "reflection/reflection_function.h"

namespace reflines {
namespace {

std::vector<int> number_smooth_triangles(const RegionField& field) {
  std::vector<int> result;
  for (int t = 0; t < field.F.rows(); ++t) {
    if (field.active(t) && !field.feature(t)) result.push_back(t);
  }
  return result;
}

}  // namespace

double evaluate_theta_near(const RegionField& field, const Location& at, const Vector2& point, double reference) {
  double sum = 0;
  const int first = field.F(at.triangle, 0);
  const double base = wrap_angle(field.vertex_theta(first) - reference);
  for (int i = 0; i < 3; ++i) {
    const int v = field.F(at.triangle, i);
    const double step = 0.5 * field.vertex_gradient.row(v).dot(point.transpose() - field.xy.row(v));
    sum += at.barycentric(i) * (wrap_angle(field.vertex_theta(v) - field.vertex_theta(first)) + step);
  }
  return wrap_angle(base + sum);
}

LineReader::LineReader(const RegionField& field)
    : number_(number_smooth_triangles(field)), smooth_(field.F(number_, Eigen::all)), locator_(field.xy, smooth_) {}

Location LineReader::locate(const Vector2& point) const {
  Location at = point.allFinite() ? locator_.locate(point) : Location();
  if (at.triangle >= 0) at.triangle = number_[at.triangle];
  return at;
}

}  // namespace reflines
