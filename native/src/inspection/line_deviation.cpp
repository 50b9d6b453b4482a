#include "inspection/line_deviation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/centroids.h"
#include "reflection/reflection_function.h"
#include "restoration/line_departure.h"
#include "restoration/triangle_slopes.h"

namespace reflines {

DeviationSum::DeviationSum(const HeightField& field, const ImagePlane& frame, PlaneVectors course, double radius,
                           bool keeps_maps)
    : field_(field),
      frame_(frame),
      slope_(find_slopes(field.xy, field.F, field.z)),
      course_slope_(std::move(course)),
      around_(find_centroids(field.xy, field.F), field.area, radius),
      keeps_maps_(keeps_maps) {
  result_.worst = Vector::Zero(field.triangle_count());
  result_.view = result_.light = result_.front_light = IndexVector::Zero(field.triangle_count());
}

void DeviationSum::add_view(const Vector3& view, const Positions& lines, const Eigen::ArrayX<bool>& counts,
                            const Vector& weight) {
  const Eigen::Index row = result_.degrees.rows();
  result_.degrees.conservativeResize(row + 1, lines.rows());
  result_.seen.conservativeResize(row + 1);
  const double seen = weight.dot(field_.area);
  result_.seen(row) = seen / field_.area.sum();
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(field_.triangle_count(), lines.rows());
  for (Eigen::Index k = 0; k < lines.rows(); ++k)
    if (counts(k)) squares.col(k) = measure_departure({frame_, view, lines.row(k)}, slope_, course_slope_, weight);
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
