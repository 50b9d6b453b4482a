#include "following/window_change.h"

#include "following/coupled_sum.h"

namespace reflines {
namespace {

// The weight of a vertex where the change is 0, relative to the mean diagonal entry of the Laplacian's square.
constexpr double kStill = 1e3;
constexpr double kDefinite = 1e-9;  // of the mean diagonal entry, added to all of them
constexpr double kRidge = 1e-11;    // of the largest diagonal entry: places may depend on each other

}  // namespace

WindowChange::WindowChange(const SplineWindow& window, const std::vector<ModeRow>& still, const Vector& firmness,
                           LinearSolverKind kind)
    : window_(window), solver_(kind) {
  CoupledSum sum(window);
  for (int s = 0; s < firmness.size(); ++s) {
    const WindowSample& sample = window.samples()[s];
    const Vector laplacian = (sample.D.row(3) + sample.D.row(5)).transpose(), rise = sample.D.row(0).transpose();
    sum.add(sample.mode, sample.area_ratio * window.area_of(sample) *
                             (laplacian * laplacian.transpose() + firmness(s) * rise * rise.transpose()));
  }
  const double scale = sum.mean_diagonal();
  for (const ModeRow& row : still) sum.add(row, kStill * scale);
  sum.add_to_diagonal(kDefinite * scale);
  solver_.analyze(sum.matrix());
  solver_.factorize(sum.matrix());
}

void WindowChange::set_places(const std::vector<ModeRow>& places) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(window_.count(), count);
  influence_.resize(window_.count(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (size_t i = 0; i < places[k].mode.size(); ++i) rows(places[k].mode[i], k) = places[k].value[i];
    Vector column = rows.col(k);
    solver_.solve(column);
    influence_.col(k) = column;
  }
  Eigen::MatrixXd system = rows.transpose() * influence_;
  system.diagonal().array() += kRidge * system.diagonal().maxCoeff();
  system_.compute(system);
}

Vector WindowChange::interpolate(const Vector& values) const {
  if (values.isZero(0.0)) return Vector::Zero(window_.count());
  return influence_ * system_.solve(values);
}

}  // namespace reflines
