#include "restoration/adaptive_smoother.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/centroids.h"
#include "restoration/bump_removal.h"
#include "restoration/disk_mean.h"
#include "restoration/press_rules.h"
#include "restoration/soft_step.h"

namespace reflines {
namespace {

constexpr double kSmoothing = 0.4;  // of a press, for the bar of its progress

double square(double x) { return x * x; }

Vector measure_steepness(const HeightField& field, const Stencils& stencils) {
  TriangleDerivatives u;
  apply_stencils(stencils, field.z, u);
  return (1.0 + u.leftCols<2>().rowwise().squaredNorm().array()).square().inverse();
}

// Returns what the means around a place are taken of: variations (#T), their logarithms, and their first and second
// moments (#T x 7).
Eigen::MatrixXd take_moments(const Vector& variation, const PlanePositions& centers) {
  Eigen::MatrixXd result(variation.size(), 7);
  const auto x = centers.col(0).array(), y = centers.col(1).array();
  result.col(0) = variation;
  result.col(1) = variation.array().log();
  result.col(2) = variation.array() * x;
  result.col(3) = variation.array() * y;
  result.col(4) = result.col(2).array() * x;
  result.col(5) = result.col(2).array() * y;
  result.col(6) = result.col(3).array() * y;
  return result;
}

// Returns the variance of place along a unit direction, weighted by the variation whose mean moments are given (7),
// relative to that of the whole disk: a sixth of its squared radius, with the weights of DiskMean.
double measure_spread(const Eigen::VectorXd& moments, const Vector2& along, double radius) {
  const Vector2 mean = moments.segment<2>(2) / moments(0);
  const double second =
      square(along.x()) * moments(4) + 2.0 * along.x() * along.y() * moments(5) + square(along.y()) * moments(6);
  return 6.0 * (second / moments(0) - square(along.dot(mean))) / square(radius);
}

double measure_longest_edge(const HeightField& field, int t) {
  double squared = 0;
  for (int i = 0; i < 3; ++i)
    squared = std::max(squared, (field.xy.row(field.F(t, i)) - field.xy.row(field.F(t, (i + 1) % 3))).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace

AdaptiveSmoother::AdaptiveSmoother(const HeightField& field, double length)
    : view_heights_(field.z),
      plane_(field),
      field_(plane_.project(field)),
      length_(length),
      variation_(field_),
      system_(variation_),
      centers_(find_centroids(field_.xy, field_.F)),
      steepness_(measure_steepness(field_, variation_.stencils())),
      open_(Vector::Ones(field.triangle_count())) {}

// Returns the weight of the variation of curvature that keeps half of a wave of this length in flawed surface.
double AdaptiveSmoother::stiffness(double smoothing_length) const {
  const double k = 2.0 * std::numbers::pi / smoothing_length;
  return (1.0 + square(kRules.scale.slope_weight * length_ / smoothing_length)) / square(k * k * k);
}

// Returns the unit of the weights of slopes, length^2.
double AdaptiveSmoother::slope_unit() const { return square(length_ / (2.0 * std::numbers::pi)); }

EdgeWeights AdaptiveSmoother::presmoothing_weights() const {
  EdgeWeights result(field_.triangle_count(), 3);
  for (int t = 0; t < field_.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int other = field_.neighbors(t, i);
      const double edge =
          std::max(measure_longest_edge(field_, t), measure_longest_edge(field_, other < 0 ? t : other));
      result(t, i) =
          stiffness(std::min(kRules.scale.presmoothed_edges * edge, kRules.scale.presmoothed_length * length_));
    }
  }
  return result;
}

// Returns how far each triangle counts as flawed surface up to a length, 0 to 1, by the curvature of heights z.
Vector AdaptiveSmoother::weigh(const Vector& z, double smoothing_length) const {
  const double flaw = kRules.scale.flaw_slope * square(2.0 * std::numbers::pi / smoothing_length);
  const Eigen::MatrixXd tensor = variation_.read_tensors(variation_.average(variation_.read_hessians(z)));
  const Eigen::MatrixXd mean =
      DiskMean(centers_, field_.area, kRules.scale.tensor_radius * smoothing_length).of_columns(tensor);
  const Vector variation = (tensor.col(0) + tensor.col(2)).array() + square(kRules.scale.nothing * flaw);
  const Eigen::MatrixXd around =
      DiskMean(centers_, field_.area, kRules.scale.around * length_).of_columns(take_moments(variation, centers_));
  Vector result(tensor.rows());
  for (Eigen::Index t = 0; t < result.size(); ++t) {
    const double xx = mean(t, 0), yy = mean(t, 2), xy = mean(t, 1), trace = xx + yy;
    const double coherence = trace > 0 ? (square(xx - yy) + 4.0 * square(xy)) / square(trace) : 0.0;
    const double typical = std::exp(around(t, 1));
    const double alike = soft_step(kRules.scale.even, typical / around(t, 0));
    const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
    const double spread =
        measure_spread(around.row(t), {std::cos(angle), std::sin(angle)}, kRules.scale.around * length_);
    const double lone = coherence * (1.0 - kRules.scale.waves * alike * soft_step(kRules.scale.spread, spread));
    const double most = square(flaw * (1.0 - kRules.scale.across_one * lone)) +
                        square(kRules.scale.typical) * typical * alike * square(1.0 - coherence);
    const double weight = 1.0 / (1.0 + trace / most);
    result(t) = weight * weight * weight;  // falls faster than the stiffness of longer lengths rises
  }
  return result;
}

// Lets what counts as flawed up to a length, by the curvature of heights z (#V), be smoothed up to it from now on.
// Smooths further, where heights z count as flawed up to a length, and returns how far each triangle (#T) does so.
Vector AdaptiveSmoother::take_step(const Vector& z, double smoothing_length, Progress* progress) {
  if (progress) progress->enter(kSmoothing, "smoothing the lines");
  const Vector flawed = weigh(z, smoothing_length);
  const double most = stiffness(smoothing_length);
  for (int t = 0; t < field_.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int other = field_.neighbors(t, i);
      if (other >= 0) weight_(t, i) = std::max(weight_(t, i), most * std::min(flawed(t), flawed(other)));
    }
  }
  open_ = open_.cwiseMax(flawed);
  factorize(progress);
  return flawed;
}

void AdaptiveSmoother::factorize(Progress* progress) {
  const Vector kept =
      square(kRules.scale.slope_weight) + square(kRules.scale.design_slope_weight) * (1.0 - open_.array());
  system_.factorize(weight_, slope_unit() * kept.cwiseProduct(steepness_), progress);
}

Vector AdaptiveSmoother::adapt(const Vector& z, Progress* progress, const Correction& correct) {
  const Vector start = plane_.project_heights(z, field_.xy);
  const Correction correct_over_plane = [&](const Vector& heights) -> Vector {
    if (!correct) return heights;
    return heights + plane_.change_over_plane(correct(take_view_heights(z, start, heights)));
  };
  return put_back(view_heights_, take_view_heights(z, start, adapt_over_plane(start, correct_over_plane, progress)));
}

Vector AdaptiveSmoother::adapt_over_plane(const Vector& start, const Correction& correct, Progress* progress) {
  weight_ = EdgeWeights::Zero(field_.triangle_count(), 3);
  open_ = Vector::Zero(field_.triangle_count());
  system_.factorize(presmoothing_weights(), slope_unit() * square(kRules.scale.slope_weight) * steepness_, progress);
  take_step(system_.smooth(start), kRules.scale.shortest * length_, progress);
  // Smoothed so far, and no further, noise does not hide dents, and the walls of a handle's recess are still no dents.
  const BumpRemoval removal = remove_bumps(
      variation_, plane_, start, length_, [&](const Vector& z) { return system_.smooth(z); }, progress);
  bumps_ = removal.count;
  const Vector corrected = correct(removal.heights);
  design_ = Vector::Ones(field_.triangle_count());
  for (const double step : kRules.scale.ladder)
    design_ -= take_step(system_.smooth(corrected), step * length_, progress) / std::size(kRules.scale.ladder);
  return system_.smooth(put_back(field_.z, corrected));
}

Vector AdaptiveSmoother::design() const {
  Vector result = Vector::Zero(field_.silhouette.size());
  result(field_.source) = design_;
  return result;
}

// Returns heights (#V) with those of the vertices that stay as they are: what was taken away there is not gone, and the
// surface beside it is to run on smoothly.
Vector AdaptiveSmoother::put_back(const Vector& held, Vector z) const {
  for (int v = 0; v < field_.vertex_count(); ++v) {
    if (field_.role[v] != VertexRole::kFree) z(v) = held(v);
  }
  return z;
}

// Returns heights along the view (#V), of which the heights over the plane were `before` and are `after`.
Vector AdaptiveSmoother::take_view_heights(const Vector& z, const Vector& before, const Vector& after) const {
  return z + plane_.change_along_view(after - before);
}

Vector AdaptiveSmoother::smooth(const Vector& z) {
  if (further_) factorize(nullptr);
  further_ = false;
  return smooth_over_plane(z);
}

Vector AdaptiveSmoother::smooth_over_plane(const Vector& z) {
  const Vector heights = plane_.project_heights(z, field_.xy);
  return take_view_heights(z, heights, system_.smooth(heights));
}

Vector AdaptiveSmoother::smooth_further(const Vector& z, Progress* progress) {
  const EdgeWeights weight = weight_;
  const Vector open = open_;
  further_ = true;
  take_step(plane_.project_heights(z, field_.xy), 2.0 * std::end(kRules.scale.ladder)[-1] * length_, progress);
  weight_ = weight;
  open_ = open;
  return smooth_over_plane(z);
}

}  // namespace reflines
