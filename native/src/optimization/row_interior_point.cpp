#include "optimization/row_interior_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflines {
namespace {

constexpr int kMaxSteps = 60;
constexpr double kShareOfLongest = 0.995;

// The slack of functions whose force counts as one of a contact, in tolerances.
constexpr double kTouching = 40.0;

// The steps after which no more digits are expected, where none of them lowers the error, or the products of slacks and
// forces by this factor.
constexpr int kPatience = 15;
constexpr double kGain = 0.5;

}  // namespace

RowInteriorPoint::RowInteriorPoint(const QuadraticModel& model, const RowLimits::Narrow& limits, const Vector& low,
                                   const Vector& high)
    : model_(model),
      limits_(limits),
      by_unknown_(limits.rows),
      d_(Vector::Zero(limits.rows.rows())),
      values_(Vector::Zero(limits.rows.cols())) {
  const double force = model_.gradient.cwiseAbs().sum() / static_cast<double>(limits.rows.cols());
  ends_ = {make_end(low, 1.0), make_end(high, -1.0)};
  double reach = 0.0;
  for (const End& end : ends_) reach = std::max(reach, end.bound.cwiseAbs().maxCoeff());
  for (int i = 0; i < values_.size(); ++i) {
    const double range = high(i) - low(i);
    for (End& end : ends_) {
      if (end.exists(i) == 0) continue;
      const double room = 0.1 * (std::isfinite(range) ? range : std::max(reach, limits.tolerance));
      end.slack(i) = std::max(-end.sign * end.bound(i), room);
    }
  }
  balance(force);
}

// Sets the forces so that all products of slack and force are equal, and the mean force is about the given one: the
// start lies on the central path of ranges of very different sizes. With equal forces 17 of 120 solves within painted
// and random limits ended without their digits, as the steps became shorter and shorter; with these one does.
void RowInteriorPoint::balance(double force) {
  double sum = 0.0, count = 0.0;
  for (const End& end : ends_) {
    sum += end.slack.dot(end.exists);
    count += end.exists.sum();
  }
  const double product = force * sum / std::max(count, 1.0);
  for (End& end : ends_) end.force = product * end.exists.cwiseQuotient(end.slack);
}

RowInteriorPoint::End RowInteriorPoint::make_end(const Vector& bound, double sign) const {
  const auto exists = bound.array().isFinite();
  return {sign, exists.cast<double>(), exists.select(bound.array(), 0.0), Vector::Ones(bound.size()),
          Vector::Zero(bound.size())};
}

// Returns H + A D A^T, the lower triangle. Each column is summed in one order, on any number of threads.
SparseMatrix RowInteriorPoint::build_matrix() const {
  const Vector diagonal = ends_[0].force.cwiseQuotient(ends_[0].slack) + ends_[1].force.cwiseQuotient(ends_[1].slack);
  SparseMatrix result = model_.H;
#pragma omp parallel if (limits_.rows.cols() > kWorthThreads)
  {
    Vector column = Vector::Zero(result.rows());
#pragma omp for schedule(static)
    for (int k = 0; k < result.cols(); ++k) {
      for (decltype(by_unknown_)::InnerIterator own(by_unknown_, k); own; ++own) {
        const double weight = own.value() * diagonal(own.col());
        for (SparseMatrix::InnerIterator entry(limits_.rows, own.col()); entry; ++entry) {
          column(entry.row()) += weight * entry.value();
        }
      }
      for (SparseMatrix::InnerIterator entry(result, k); entry; ++entry) entry.valueRef() += column(entry.row());
      for (decltype(by_unknown_)::InnerIterator own(by_unknown_, k); own; ++own) {
        for (SparseMatrix::InnerIterator entry(limits_.rows, own.col()); entry; ++entry) column(entry.row()) = 0.0;
      }
    }
  }
  return result;
}

Vector RowInteriorPoint::dual_residual() const {
  Vector residual = model_.gradient_at(d_) - limits_.rows * present_forces();
  for (int k = 0; k < residual.size(); ++k) {
    if (limits_.held[k] != Side::kBetween) residual(k) = 0.0;
  }
  return residual;
}

// Solves Newton's system for residuals of 0 and a change of the products by `products`.
RowInteriorPoint::Change RowInteriorPoint::solve(HeldFactor& factor, const Products& products) const {
  Change change;
  Vector pull = Vector::Zero(values_.size());
  for (int b = 0; b < 2; ++b) {
    const End& end = ends_[b];
    change.slack[b] = end.exists.cwiseProduct(end.sign * (values_ - end.bound) - end.slack);
    change.force[b] = (products[b] - end.force.cwiseProduct(change.slack[b])).cwiseQuotient(end.slack);
    pull += end.sign * change.force[b];
  }
  change.d = limits_.rows * pull - dual_residual();
  const Vector right = change.d;
  factor.solve(change.d);
  Vector left = right - matrix_.selfadjointView<Eigen::Lower>() * change.d;
  factor.solve(left);
  change.d += left;
  const Vector moved = limits_.rows.transpose() * change.d;
  for (int b = 0; b < 2; ++b) {
    const End& end = ends_[b];
    const Vector along = end.sign * end.exists.cwiseProduct(moved);
    change.slack[b] += along;
    change.force[b] -= end.force.cwiseProduct(along).cwiseQuotient(end.slack);
  }
  return change;
}

double RowInteriorPoint::longest(const Change& change) const {
  double step = 2.0;
  for (int b = 0; b < 2; ++b) {
    for (int i = 0; i < values_.size(); ++i) {
      if (change.slack[b](i) < 0) step = std::min(step, -ends_[b].slack(i) / change.slack[b](i));
      if (change.force[b](i) < 0) step = std::min(step, -ends_[b].force(i) / change.force[b](i));
    }
  }
  return step;
}

double RowInteriorPoint::mean_product(const Change& change, double step) const {
  double sum = 0.0, count = 0.0;
  for (int b = 0; b < 2; ++b) {
    sum += (ends_[b].slack + step * change.slack[b]).dot(ends_[b].force + step * change.force[b]);
    count += ends_[b].exists.sum();
  }
  return sum / std::max(count, 1.0);
}

// Returns how much more than the tolerance a function is beyond its range, or how much more than wanted the gradient
// has left, whichever is more: at most 1 at a solution.
double RowInteriorPoint::measure_error(double tolerance, double wanted) const {
  Vector stray = Vector::Zero(values_.size());
  double beyond = 0.0;
  for (const End& end : ends_) {
    const Vector slack = end.sign * (values_ - end.bound);
    for (int i = 0; i < stray.size(); ++i) {
      if (end.exists(i) == 0) continue;
      beyond = std::max(beyond, -slack(i));
      if (slack(i) > kTouching * tolerance) stray(i) += end.sign * end.force(i);
    }
  }
  return std::max(beyond / tolerance, ((limits_.rows * stray).norm() + dual_residual().norm()) / wanted);
}

void RowInteriorPoint::move(const Change& change) {
  const double step = std::min(1.0, kShareOfLongest * longest(change));
  d_ += step * change.d;
  values_ = limits_.rows.transpose() * d_;
  for (int b = 0; b < 2; ++b) {
    ends_[b].slack += step * change.slack[b];
    ends_[b].force += step * change.force[b];
  }
}

RowInteriorPoint::Change RowInteriorPoint::predict_and_correct(HeldFactor& factor) const {
  Products products;
  for (int b = 0; b < 2; ++b) products[b] = -ends_[b].slack.cwiseProduct(ends_[b].force);
  const Change predicted = solve(factor, products);
  const double now = mean_product(predicted, 0.0);
  const double reached = mean_product(predicted, std::min(1.0, longest(predicted)));
  const double aim = now * std::pow(std::max(reached / now, 0.0), 3);
  for (int b = 0; b < 2; ++b) {
    products[b] += aim * ends_[b].exists - predicted.slack[b].cwiseProduct(predicted.force[b]);
  }
  return solve(factor, products);
}

void RowInteriorPoint::run(HeldFactor& factor, double tolerance, double wanted, Report& counts,
                           const Progress* progress) {
  double best = std::numeric_limits<double>::infinity(), least_product = best;
  int since = 0;
  for (int iteration = 0; iteration < kMaxSteps && since < kPatience; ++iteration, ++since) {
    matrix_ = build_matrix();
    factor.factorize(matrix_, limits_.held, progress);
    ++counts.factorizations;
    counts.solves += 2;
    const Change change = predict_and_correct(factor);
    move(change);
    const double product = mean_product(change, 0.0);
    if (product < kGain * least_product) since = 0;
    least_product = std::min(least_product, product);
    const double error = measure_error(tolerance, wanted);
    if (!(error < best)) continue;
    best = error;
    since = 0;
    best_step_ = d_;
    best_forces_ = present_forces();
    if (best <= 1.0) break;
  }
}

}  // namespace reflines
