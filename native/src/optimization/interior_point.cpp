#include "optimization/interior_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflines {
namespace {

// The number of further correctors. A factorization takes as long as ten solves; on the bump problems three took 14
// instead of 19 factorizations, and more saved none.
constexpr int kFurtherCorrectors = 3;

// Gondzio's range of the products of slack and force, relative to the wanted product.
constexpr double kSmallestProduct = 0.1, kLargestProduct = 10.0;

constexpr double kShareOfLongest = 0.995;

// The relative change of the estimated set at which the iteration stops: the active set method finds the rest faster.
constexpr double kSettled = 0.02;

// The relative size of the products of slack and force above which the estimate is meaningless.
constexpr double kSmallGap = 1e-5;

}  // namespace

InteriorPoint::InteriorPoint(const QuadraticModel& model, const Bounds& bounds, double reach)
    : model_(model), fixed_(bounds.low.size(), Side::kBetween), d_(Vector::Zero(bounds.low.size())) {
  for (int k = 0; k < d_.size(); ++k) {
    if (!bounds.is_point(k)) continue;
    fixed_[k] = Side::kLow;
    d_(k) = bounds.low(k);
  }
  gradient_ = model_.gradient_at(d_);
  const double force = gradient_.cwiseAbs().mean();
  barriers_ = {make_barrier(bounds.low, 1.0, force), make_barrier(bounds.high, -1.0, force)};
  for (int k = 0; k < d_.size(); ++k) {
    const double range = bounds.high(k) - bounds.low(k);
    for (Barrier& barrier : barriers_) {
      if (barrier.exists(k) == 0) continue;
      const double room = std::isfinite(range) ? 0.1 * range : reach;
      barrier.slack(k) = std::max(barrier.sign * (d_(k) - barrier.bound(k)), room);
      ++barrier_count_;
    }
  }
}

InteriorPoint::Barrier InteriorPoint::make_barrier(const Vector& bound, double sign, double force) const {
  Barrier barrier{sign, Vector::Zero(bound.size()), Vector::Zero(bound.size()), Vector::Ones(bound.size()),
                  Vector::Zero(bound.size())};
  for (int k = 0; k < bound.size(); ++k) {
    if (fixed_[k] != Side::kBetween || !std::isfinite(bound(k))) continue;
    barrier.exists(k) = 1.0;
    barrier.bound(k) = bound(k);
    barrier.force(k) = force + std::max(sign * gradient_(k), 0.0);  // balances the gradient, with a margin
  }
  return barrier;
}

bool InteriorPoint::step(HeldFactor& factor, Report& counts, const Progress* progress) {
  factor.factorize(model_.H, fixed_, progress, barrier_diagonal());
  ++counts.factorizations;
  Change change = predict_and_correct(factor, counts);
  for (int k = 0; k < kFurtherCorrectors; ++k) {
    ++counts.solves;
    if (longest(change) > 0.95 || !correct_further(factor, change)) break;
  }
  move(change, std::min(1.0, kShareOfLongest * longest(change)));
  const Sides before = std::exchange(last_guess_, guess());
  const int held = count_held(last_guess_) - count_held(fixed_);
  const bool settled = held > 0 && count_changes(before, last_guess_) <= 2 + kSettled * held;
  const double product = mean_product(change, 0.0);
  if (first_product_ == 0.0) first_product_ = product;
  return !settled || product > kSmallGap * first_product_;
}

// Returns the unknowns whose force is larger than the slack times their own stiffness.
Sides InteriorPoint::guess() const {
  Sides guess = fixed_;
  for (int k = 0; k < d_.size(); ++k) {
    for (const Barrier& barrier : barriers_) {
      if (barrier.exists(k) != 0 && barrier.force(k) > stiffness(k) * barrier.slack(k)) {
        guess[k] = barrier.sign > 0 ? Side::kLow : Side::kHigh;
      }
    }
  }
  return guess;
}

Vector InteriorPoint::barrier_diagonal() const {
  return barriers_[0].force.cwiseQuotient(barriers_[0].slack) + barriers_[1].force.cwiseQuotient(barriers_[1].slack);
}

Vector InteriorPoint::compute_missed_slack(const Barrier& barrier) const {
  return barrier.exists.cwiseProduct(barrier.sign * (d_ - barrier.bound) - barrier.slack);
}

Vector InteriorPoint::dual_residual() const { return gradient_ - barriers_[0].force + barriers_[1].force; }

// Solves Newton's system for a change of the products by `products` and, where asked for, for residuals of 0.
InteriorPoint::Change InteriorPoint::solve(HeldFactor& factor, const Products& products, bool residuals) const {
  Change change;
  change.d = residuals ? Vector(-dual_residual()) : Vector::Zero(d_.size());
  for (int b = 0; b < 2; ++b) {
    const Barrier& barrier = barriers_[b];
    change.slack[b] = residuals ? compute_missed_slack(barrier) : Vector::Zero(d_.size());
    change.force[b] = (products[b] - barrier.force.cwiseProduct(change.slack[b])).cwiseQuotient(barrier.slack);
    change.d += barrier.sign * change.force[b];
  }
  factor.solve(change.d);
  for (int b = 0; b < 2; ++b) {
    const Barrier& barrier = barriers_[b];
    const Vector along = barrier.sign * barrier.exists.cwiseProduct(change.d);
    change.slack[b] += along;
    change.force[b] -= barrier.force.cwiseProduct(along).cwiseQuotient(barrier.slack);
  }
  return change;
}

InteriorPoint::Change InteriorPoint::predict_and_correct(HeldFactor& factor, Report& counts) {
  Products products;
  for (int b = 0; b < 2; ++b) products[b] = -barriers_[b].slack.cwiseProduct(barriers_[b].force);
  const Change predicted = solve(factor, products, true);
  const double now = mean_product(predicted, 0.0);
  const double reached = mean_product(predicted, std::min(1.0, longest(predicted)));
  wanted_product_ = now * std::pow(reached / now, 3);
  for (int b = 0; b < 2; ++b) {
    products[b] += wanted_product_ * barriers_[b].exists - predicted.slack[b].cwiseProduct(predicted.force[b]);
  }
  counts.solves += 2;
  return solve(factor, products, true);
}

// Corrects the products that a longer step would leave far too small or too large; returns false where that did not
// help.
bool InteriorPoint::correct_further(HeldFactor& factor, Change& change) const {
  const double now = std::min(1.0, longest(change));
  const double aimed_at = std::min(1.0, std::max(1.5 * now, now + 0.3));
  Products products;
  for (int b = 0; b < 2; ++b) {
    const Barrier& barrier = barriers_[b];
    const Vector product =
        (barrier.slack + aimed_at * change.slack[b]).cwiseProduct(barrier.force + aimed_at * change.force[b]);
    products[b] =
        product.cwiseMax(kSmallestProduct * wanted_product_).cwiseMin(kLargestProduct * wanted_product_) - product;
    products[b] = barrier.exists.cwiseProduct(products[b].cwiseMax(-kLargestProduct * wanted_product_));
  }
  Change further = solve(factor, products, false);
  further.d += change.d;
  for (int b = 0; b < 2; ++b) {
    further.slack[b] += change.slack[b];
    further.force[b] += change.force[b];
  }
  if (longest(further) < now + 0.003) return false;
  change = std::move(further);
  return true;
}

double InteriorPoint::longest(const Change& change) const {
  double step = 2.0;
  for (int b = 0; b < 2; ++b) {
    for (int k = 0; k < d_.size(); ++k) {
      if (change.slack[b](k) < 0) step = std::min(step, -barriers_[b].slack(k) / change.slack[b](k));
      if (change.force[b](k) < 0) step = std::min(step, -barriers_[b].force(k) / change.force[b](k));
    }
  }
  return step;
}

double InteriorPoint::mean_product(const Change& change, double step) const {
  double sum = 0.0;
  for (int b = 0; b < 2; ++b) {
    sum += (barriers_[b].slack + step * change.slack[b]).dot(barriers_[b].force + step * change.force[b]);
  }
  return sum / std::max(1, barrier_count_);
}

void InteriorPoint::move(const Change& change, double step) {
  d_ += step * change.d;
  for (int b = 0; b < 2; ++b) {
    barriers_[b].slack += step * change.slack[b];
    barriers_[b].force += step * change.force[b];
  }
  gradient_ = model_.gradient_at(d_);
}

}  // namespace reflines
