#include "optimization/projected_relaxation.h"

#include <algorithm>

namespace reflines {
namespace {

// An unknown goes this far, relative to the minimum along it, but for the last sweeps, in which contacts settle.
constexpr double kOverRelaxation = 1.5;
constexpr int kSettlingSweeps = 4;

void sweep(const QuadraticModel& model, const SparseMatrix& whole, const Bounds& bounds, bool backwards,
           double relaxation, Vector& d, Vector& gradient) {
  const auto size = static_cast<int>(d.size());
  for (int i = 0; i < size; ++i) {
    const int k = backwards ? size - 1 - i : i;
    const double stiffness = model.H.valuePtr()[model.H.outerIndexPtr()[k]];
    if (!(stiffness > 0)) continue;  // Newton's matrix may be indefinite
    const double end = std::clamp(d(k) - relaxation * gradient(k) / stiffness, bounds.low(k), bounds.high(k));
    const double move = end - d(k);
    if (move == 0) continue;
    for (SparseMatrix::InnerIterator entry(whole, k); entry; ++entry) gradient(entry.row()) += entry.value() * move;
    d(k) = end;
  }
}

}  // namespace

Sides relax_contacts(const QuadraticModel& model, const SparseMatrix& whole, const Bounds& bounds, const Vector& d,
                     int sweeps, const Progress* progress) {
  Vector x = bounds.nearest(d), gradient = model.gradient_at(x);
  for (int k = 0; k < sweeps && !(progress != nullptr && progress->cancelled()); ++k)
    sweep(model, whole, bounds, k % 2 == 1, k + kSettlingSweeps < sweeps ? kOverRelaxation : 1.0, x, gradient);
  Sides held = bounds.points();
  for (int k = 0; k < x.size(); ++k) {
    if (bounds.is_point(k)) continue;
    if (x(k) <= bounds.low(k) && gradient(k) > 0) held[k] = Side::kLow;
    if (x(k) >= bounds.high(k) && gradient(k) < 0) held[k] = Side::kHigh;
  }
  return held;
}

}  // namespace reflines
