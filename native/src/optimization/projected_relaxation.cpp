#include "optimization/projected_relaxation.h"

#include <algorithm>

namespace reflines {
namespace {

// An unknown goes this far, relative to the minimum along it, but for the last sweeps, in which contacts settle.
constexpr double kOverRelaxation = 1.5;
constexpr int kSettlingSweeps = 4;

}  // namespace

ProjectedRelaxation::ProjectedRelaxation(const QuadraticModel& model, const Bounds& bounds, const Progress* progress)
    : model_(model), bounds_(bounds), progress_(progress) {}

Sides ProjectedRelaxation::estimate_held(const Vector& d, int sweeps) {
  if (H_.rows() == 0) H_ = model_.H.selfadjointView<Eigen::Lower>();
  Vector x = bounds_.nearest(d), gradient = model_.gradient_at(x);
  for (int k = 0; k < sweeps && !(progress_ != nullptr && progress_->cancelled()); ++k)
    sweep(k % 2 == 1, k + kSettlingSweeps < sweeps ? kOverRelaxation : 1.0, x, gradient);
  Sides held = bounds_.points();
  for (int k = 0; k < x.size(); ++k) {
    if (bounds_.is_point(k)) continue;
    if (x(k) <= bounds_.low(k) && gradient(k) > 0) held[k] = Side::kLow;
    if (x(k) >= bounds_.high(k) && gradient(k) < 0) held[k] = Side::kHigh;
  }
  return held;
}

void ProjectedRelaxation::sweep(bool backwards, double relaxation, Vector& d, Vector& gradient) const {
  const auto size = static_cast<int>(d.size());
  for (int i = 0; i < size; ++i) {
    const int k = backwards ? size - 1 - i : i;
    const double stiffness = model_.H.valuePtr()[model_.H.outerIndexPtr()[k]];
    if (!(stiffness > 0)) continue;  // Newton's matrix may be indefinite
    const double end = std::clamp(d(k) - relaxation * gradient(k) / stiffness, bounds_.low(k), bounds_.high(k));
    const double move = end - d(k);
    if (move == 0) continue;
    for (SparseMatrix::InnerIterator entry(H_, k); entry; ++entry) gradient(entry.row()) += entry.value() * move;
    d(k) = end;
  }
}

}  // namespace reflines
