#include "inspection/line_deviation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/smoothstep.h"
#include "reflection/reflection_function.h"
#include "reflection/scalar_gradient.h"
#include "restoration/centroids.h"

namespace reflines {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Degrees that count of a deviation at most: beyond, lines have no course.
constexpr double kFarthest = 45.0;

// The sine of the angle between reflected ray and light lines: theta turns fast, and counts less, below the second.
constexpr double kUndefined = 0.05, kDefined = 0.2;

}  // namespace

PlaneVectors find_slopes(const HeightField& field, const Vector& z) {
  PlaneVectors result(field.triangle_count(), 2);
  for (int t = 0; t < field.triangle_count(); ++t) {
    const double a = z(field.F(t, 0));
    result.row(t) = linear_gradient(field.xy, field.F.row(t), z(field.F(t, 1)) - a, z(field.F(t, 2)) - a);
  }
  return result;
}

DeviationSum::DeviationSum(const HeightField& field, const ImagePlane& frame, PlaneVectors course, double radius,
                           bool keeps_maps)
    : field_(field),
      frame_(frame),
      slope_(find_slopes(field, field.z)),
      course_slope_(std::move(course)),
      around_(find_centroids(field.xy, field.F), field.area, radius),
      keeps_maps_(keeps_maps) {
  result_.worst = Vector::Zero(field.triangle_count());
  result_.view = result_.light = result_.front_light = IndexVector::Zero(field.triangle_count());
}

// Returns the weighted squared deviation of each triangle (#T, degrees^2) in one light from one view.
Vector DeviationSum::measure(const Vector3& view, const Vector3& line, const Vector& weight) const {
  const ReflectionFunction reflection(frame_, view, line);
  Vector result(slope_.rows());
#pragma omp parallel for schedule(static) if (slope_.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(slope_.rows()); ++t) {
    const double p = slope_(t, 0), q = slope_(t, 1), p0 = course_slope_(t, 0), q0 = course_slope_(t, 1);
    const double visibility = std::min(reflection.visibility(p, q), reflection.visibility(p0, q0));
    const double off = kDegrees * std::abs(wrap_angle(reflection.theta(p, q) - reflection.theta(p0, q0)));
    const double counted = smoothstep(kUndefined, kDefined, visibility) * std::min(off, kFarthest);
    result(t) = weight(t) * counted * counted;
  }
  return result;
}

void DeviationSum::add_view(const Vector3& view, const Positions& lines, const Vector& weight) {
  const Eigen::Index row = result_.degrees.rows();
  result_.degrees.conservativeResize(row + 1, lines.rows());
  result_.seen.conservativeResize(row + 1);
  const double seen = weight.dot(field_.area);
  result_.seen(row) = seen / field_.area.sum();
  Eigen::MatrixXd squares(field_.triangle_count(), lines.rows());
  for (Eigen::Index k = 0; k < lines.rows(); ++k) squares.col(k) = measure(view, lines.row(k), weight);
  result_.degrees.row(row) = (field_.area.transpose() * squares / std::max(seen, 1e-300)).cwiseSqrt();
  const Eigen::MatrixXd mean = around_.of_columns(squares);
  if (keeps_maps_) keep_map(mean);
  for (Eigen::Index t = 0; t < mean.rows(); ++t) {
    Eigen::Index light = 0;
    const double worst = std::sqrt(mean.row(t).maxCoeff(&light));
    if (row == 0) result_.front_light(t) = static_cast<int>(light);
    if (worst <= result_.worst(t)) continue;
    result_.worst(t) = worst;
    result_.view(t) = static_cast<int>(row);
    result_.light(t) = static_cast<int>(light);
  }
}

void DeviationSum::keep_map(const Eigen::MatrixXd& mean) {
  const Eigen::Index before = result_.maps.cols();
  result_.maps.conservativeResize(mean.rows(), before + mean.cols());
  result_.maps.rightCols(mean.cols()) = mean.cwiseSqrt().cast<float>();
}

}  // namespace reflines
