#include "reflines/pattern_target.h"

#include <algorithm>
#include <cmath>

#include "base/parallel_failure.h"
#include "reflection/reflection_function.h"
#include "reflection/scalar_gradient.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr int kColumns = 64;  // blurred by one thread at a time

// The deviation, pixels, up to which the weights of a pixel's neighbours are 0 to the last bit; the square of one far
// smaller is 0 too.
constexpr double kLeastBlur = 0.02;

// The number of products of a direct convolution that takes about a second on two cores: 90 pixels on 1024 x 1024.
constexpr double kDirectBlur = 1e9;

// Returns the Gaussian weights of -radius .. radius pixels; at 4 deviations it is 3e-4 of its middle.
Vector compute_gaussian(double deviation) {
  const int radius = static_cast<int>(std::ceil(4 * deviation));
  Vector kernel(2 * radius + 1);
  for (int k = -radius; k <= radius; ++k) kernel(k + radius) = std::exp(-0.5 * k * k / (deviation * deviation));
  return kernel / kernel.sum();
}

// Convolves the columns of `image`, with border values continued; a whole column for each weight, as they lie in
// memory: row by row it takes 40 times as long.
Eigen::MatrixXd blur_columns(const Eigen::MatrixXd& image, const Vector& kernel) {
  const Eigen::Index rows = image.rows(), radius = kernel.size() / 2;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, image.cols());
  run_parallel(static_cast<int>(image.cols()), kColumns, [&](int c) {
    Vector column(rows + 2 * radius);
    column << Vector::Constant(radius, image(0, c)), image.col(c), Vector::Constant(radius, image(rows - 1, c));
    for (Eigen::Index k = 0; k < kernel.size(); ++k) result.col(c) += kernel(k) * column.segment(k, rows);
  });
  return result;
}

// Approximates the Gaussian of the columns, borders continued, by five box filters, which have its variance and 97 % of
// its height in the middle, in a time that does not depend on the deviation (Kovesi, "Fast Almost-Gaussian Filtering",
// DICTA 2010).
Eigen::MatrixXd box_blur_columns(Eigen::MatrixXd image, double deviation) {
  constexpr int kPasses = 5;
  const double ideal = std::sqrt(12 * deviation * deviation / kPasses + 1);
  const int lower = 2 * static_cast<int>((ideal - 1) / 2) + 1;  // the odd widths around the ideal one
  const double short_passes =
      (12 * deviation * deviation - kPasses * (lower + 1.0) * (lower + 3.0) + 2.0 * kPasses) / (-4.0 * lower - 4.0);
  const Eigen::Index rows = image.rows();
  for (int pass = 0; pass < kPasses; ++pass) {
    const Eigen::Index radius = (pass < std::lround(short_passes) ? lower : lower + 2) / 2;
    run_parallel(static_cast<int>(image.cols()), kColumns, [&](int c) {
      Vector column = image.col(c);
      const auto at = [&](Eigen::Index r) { return column(std::clamp<Eigen::Index>(r, 0, rows - 1)); };
      double sum = (radius + 1) * column(0);
      for (Eigen::Index r = 1; r <= radius; ++r) sum += at(r);
      for (Eigen::Index r = 0; r < rows; ++r) {
        image(r, c) = sum / static_cast<double>(2 * radius + 1);
        sum += at(r + radius + 1) - at(r - radius);
      }
    });
  }
  return image;
}

Eigen::MatrixXd blurred(const Eigen::MatrixXd& image, double deviation) {
  if (!(deviation > kLeastBlur)) return image;
  if (8 * deviation * static_cast<double>(image.size()) > kDirectBlur) {
    const Eigen::MatrixXd once = box_blur_columns(image, deviation).transpose();
    return box_blur_columns(once, deviation).transpose();
  }
  const Vector kernel = compute_gaussian(deviation);
  const Eigen::MatrixXd once = blur_columns(image, kernel).transpose();
  return blur_columns(once, kernel).transpose();
}

// Returns the Catmull-Rom weights of the four samples around a point at `f` in [0, 1] between the middle two.
Eigen::Vector4d compute_cubic_weights(double f) {
  return {0.5 * (-f + 2 * f * f - f * f * f), 0.5 * (2 - 5 * f * f + 3 * f * f * f),
          0.5 * (f + 4 * f * f - 3 * f * f * f), 0.5 * (-f * f + f * f * f)};
}

// Interpolates the grey value at pixel coordinates (pixel centres at whole numbers) smoothly: bilinear interpolation
// would print the pixels' edges into the gradient.
double sample(const Eigen::MatrixXd& image, double column, double row) {
  column = column > 0 ? std::min(column, double(image.cols() - 1)) : 0;  // NaN becomes 0
  row = row > 0 ? std::min(row, double(image.rows() - 1)) : 0;
  const int i = static_cast<int>(column), j = static_cast<int>(row);
  const Eigen::Vector4d wx = compute_cubic_weights(column - i), wy = compute_cubic_weights(row - j);
  double sum = 0;
  for (int b = -1; b <= 2; ++b) {
    const int r = std::clamp<int>(j + b, 0, static_cast<int>(image.rows()) - 1);
    for (int a = -1; a <= 2; ++a) {
      sum += wy(b + 1) * wx(a + 1) * image(r, std::clamp<int>(i + a, 0, static_cast<int>(image.cols()) - 1));
    }
  }
  return sum;
}

void check(const Eigen::MatrixXd& image, const PatternOptions& options) {
  if (image.size() == 0 || !image.allFinite())
    throw InvalidInput("The image is empty or has values that are not finite.");
  if (!(options.width > 0)) throw InvalidInput("The width of the image in the scene must be positive.");
  if (!options.centre.allFinite() || !std::isfinite(options.angle + options.width + options.strength)) {
    throw InvalidInput("The centre, angle, width or strength of the image is not a finite number; type it again.");
  }
  if (!(options.blur >= 0 && options.blur <= static_cast<double>(image.rows() + image.cols()))) {
    throw InvalidInput("The blur must be positive and no wider than the image of " + std::to_string(image.cols()) +
                       " x " + std::to_string(image.rows()) + " pixels.");
  }
  if (!(options.keep >= 0 && options.keep <= 1))
    throw InvalidInput("The share of the lines to keep must lie between 0 and 1.");
}

// Returns the image's contribution to theta at the vertices (#V).
Vector compute_added_theta(const RegionField& field, const Eigen::MatrixXd& image, const PatternOptions& options) {
  const Eigen::MatrixXd soft = blurred(image, options.blur);
  const double pixel = options.width / image.cols();
  Vector delta(field.xy.rows());
  for (int v = 0; v < delta.size(); ++v) {
    const Vector2 d = field.xy.row(v).transpose() - options.centre;
    const Vector2 turned(std::cos(options.angle) * d.x() + std::sin(options.angle) * d.y(),
                         -std::sin(options.angle) * d.x() + std::cos(options.angle) * d.y());
    delta(v) = options.strength * sample(soft, turned.x() / pixel + 0.5 * (image.cols() - 1),
                                         turned.y() / pixel + 0.5 * (image.rows() - 1));
  }
  return delta;
}

// Returns keep * (theta - mean) + mean (#F); the mean of directions, since theta may jump by 2 pi within the region.
Vector scale_theta(const RegionField& field, double keep) {
  if (keep == 1) return field.theta;
  const double mean = std::atan2(field.area.dot(field.theta.array().sin().matrix()),
                                 field.area.dot(field.theta.array().cos().matrix()));
  return field.theta.unaryExpr([mean, keep](double theta) { return mean + keep * wrap_angle(theta - mean); });
}

}  // namespace

Target build_pattern_target(const RegionField& field, const Eigen::MatrixXd& image, const PatternOptions& options) {
  check(image, options);
  const Vector delta = compute_added_theta(field, image, options);
  Target target{field.gradient, {}, {}, field.family, true};
  if (options.by_value) target.theta = field.theta;
  const Vector kept = scale_theta(field, options.keep);
  for (int t = 0; t < field.F.rows(); ++t) {
    const double response = field.response(t);
    if (!field.active(t) || response == 0) continue;
    const double at_a = delta(field.F(t, 0));
    const Vector2 gradient =
        linear_gradient(field.xy, field.F.row(t), delta(field.F(t, 1)) - at_a, delta(field.F(t, 2)) - at_a);
    const Vector2 now = field.gradient.row(t), wanted = options.keep * now + gradient;
    target.gradient.row(t) = (now + response * (wanted - now)).transpose();
    if (!options.by_value) continue;
    const double added = (at_a + delta(field.F(t, 1)) + delta(field.F(t, 2))) / 3.0;
    target.theta(t) = field.theta(t) + response * (kept(t) + added - field.theta(t));
  }
  return target;
}

}  // namespace reflines
