#include "optimization/interior_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel_failure.h"

namespace reflines {
namespace {

constexpr int kMaxSteps = 60;
constexpr double kFractionOfLongest = 0.995;

// A factorization takes as long as ten solves: three further correctors save a quarter of the factorizations, and more
// save none.
constexpr int kFurtherCorrectors = 3;

// Gondzio's range of the products of slack and force, relative to the wanted product.
constexpr double kSmallestProduct = 0.1, kLargestProduct = 10.0;

// The slack of functions whose force counts as one of a contact, in tolerances.
constexpr double kTouching = 40.0;

// The steps after which no more digits are expected, where none of them lowers the error, or the products of slacks and
// forces by this factor.
constexpr int kPatience = 15;
constexpr double kGain = 0.5;

constexpr int kBlock = 256;  // columns of the matrix that a thread sums at a time

class InteriorPoint {
 public:
  InteriorPoint(const QuadraticModel& model, const StepLimits& limits, double extent, HeldFactor& factor,
                const Progress* progress)
      : model_(model),
        limits_(limits),
        factor_(factor),
        progress_(progress),
        d_(Vector::Zero(model.gradient.size())),
        values_(Vector::Zero(limits.range.low.size())) {
    if (limits.rows != nullptr) by_unknown_ = *limits.rows;
    ends_ = {make_end(limits.range.low, 1.0), make_end(limits.range.high, -1.0)};
    place_start(extent);
  }

  InteriorMinimum minimize(double tolerance, double wanted) {
    InteriorMinimum result;
    double best = std::numeric_limits<double>::infinity(), least_product = best;
    int since = 0;
    for (int step = 0; step < kMaxSteps && since < kPatience && best > 1.0; ++step, ++since) {
      iterate();
      const double product = mean_product(), error = measure_error(tolerance, wanted);
      if (product < kGain * least_product || error < best) since = 0;
      least_product = std::min(least_product, product);
      if (!(error < best)) continue;
      best = error;
      result = {d_, present_forces()};
    }
    return result;
  }

 private:
  // One end of every range: slack = sign (A d - bound) > 0, and force > 0 is its multiplier.
  struct End {
    double sign;
    Vector exists;  // 1, or 0 where the range is infinite or a point
    Vector bound;   // 0 there
    Vector slack;   // 1 there
    Vector force;   // 0 there
  };
  struct Change {
    Vector d;
    std::array<Vector, 2> slack, force;
  };
  using Products = std::array<Vector, 2>;  // wanted change of slack times force, at each end

  End make_end(const Vector& bound, double sign) const {
    const auto exists = bound.array().isFinite() && limits_.range.low.array() < limits_.range.high.array();
    return {sign, exists.cast<double>(), exists.select(bound.array(), 0.0), Vector::Ones(bound.size()),
            Vector::Zero(bound.size())};
  }

  // Sets the slacks, and the forces so that all products are equal and the mean force is that of the gradient: the
  // start lies on the central path of ranges of very different sizes. With equal forces 17 of 120 solves within painted
  // and random limits ended without their digits; with these one does.
  void place_start(double extent) {
    double sum = 0.0, count = 0.0;
    for (End& end : ends_) {
      for (int i = 0; i < values_.size(); ++i) {
        if (end.exists(i) == 0) continue;
        const double range = limits_.range.high(i) - limits_.range.low(i);
        end.slack(i) = std::max(-end.sign * end.bound(i), 0.1 * (std::isfinite(range) ? range : extent));
      }
      sum += end.slack.dot(end.exists);
      count += end.exists.sum();
    }
    const double force = model_.gradient.cwiseAbs().sum() / static_cast<double>(values_.size());
    const double product = force * sum / std::max(count, 1.0);
    for (End& end : ends_) end.force = product * end.exists.cwiseQuotient(end.slack);
  }

  // Returns H + A^T D A, the lower triangle. Each column is summed in one order, on any number of threads.
  SparseMatrix build_matrix() const {
    const Vector diagonal = ends_[0].force.cwiseQuotient(ends_[0].slack) + ends_[1].force.cwiseQuotient(ends_[1].slack);
    SparseMatrix result = model_.H;
    if (limits_.rows == nullptr) {
      for (int k = 0; k < result.cols(); ++k) result.valuePtr()[result.outerIndexPtr()[k]] += diagonal(k);
      return result;
    }
    const SparseMatrix& rows = *limits_.rows;
    const int size = static_cast<int>(result.cols());
    run_parallel((size + kBlock - 1) / kBlock, 1, [&](int block) {
      Vector column = Vector::Zero(size);
      for (int k = block * kBlock; k < std::min(size, (block + 1) * kBlock); ++k) {
        for (decltype(by_unknown_)::InnerIterator own(by_unknown_, k); own; ++own) {
          const double weight = own.value() * diagonal(own.col());
          for (SparseMatrix::InnerIterator entry(rows, own.col()); entry; ++entry) {
            column(entry.row()) += weight * entry.value();
          }
        }
        for (SparseMatrix::InnerIterator entry(result, k); entry; ++entry) entry.valueRef() += column(entry.row());
        for (decltype(by_unknown_)::InnerIterator own(by_unknown_, k); own; ++own) {
          for (SparseMatrix::InnerIterator entry(rows, own.col()); entry; ++entry) column(entry.row()) = 0.0;
        }
      }
    });
    return result;
  }

  Vector dual_residual() const {
    Vector residual = model_.gradient_at(d_) - limits_.pull(present_forces());
    clear_held(limits_.held, residual);
    return residual;
  }

  // Solves with a refinement that brings back the digits which A^T D A loses; D alone loses none.
  Vector solve_system(const Vector& right) {
    Vector x = right;
    factor_.solve(x);
    if (limits_.rows == nullptr) return x;
    Vector left = right - matrix_.selfadjointView<Eigen::Lower>() * x;
    factor_.solve(left);
    return x + left;
  }

  // Solves Newton's system for a change of the products by `products` and, where asked for, for residuals of 0.
  Change solve(const Products& products, bool residuals) {
    Change change;
    Vector force = Vector::Zero(values_.size());
    for (int b = 0; b < 2; ++b) {
      const End& end = ends_[b];
      change.slack[b] = Vector::Zero(values_.size());
      if (residuals) change.slack[b] = end.exists.cwiseProduct(end.sign * (values_ - end.bound) - end.slack);
      change.force[b] = (products[b] - end.force.cwiseProduct(change.slack[b])).cwiseQuotient(end.slack);
      force += end.sign * change.force[b];
    }
    Vector right = limits_.pull(force);
    if (residuals) right -= dual_residual();
    change.d = solve_system(right);
    const Vector moved = limits_.values(change.d);
    for (int b = 0; b < 2; ++b) {
      const End& end = ends_[b];
      const Vector along = end.sign * end.exists.cwiseProduct(moved);
      change.slack[b] += along;
      change.force[b] -= end.force.cwiseProduct(along).cwiseQuotient(end.slack);
    }
    return change;
  }

  // Returns the change and the product that it aims at.
  std::pair<Change, double> predict_and_correct() {
    Products products;
    for (int b = 0; b < 2; ++b) products[b] = -ends_[b].slack.cwiseProduct(ends_[b].force);
    const Change predicted = solve(products, true);
    const double now = mean_product(), reached = mean_product(predicted, std::min(1.0, longest(predicted)));
    const double wanted = now * std::pow(std::max(reached / now, 0.0), 3);
    for (int b = 0; b < 2; ++b) {
      products[b] += wanted * ends_[b].exists - predicted.slack[b].cwiseProduct(predicted.force[b]);
    }
    return {solve(products, true), wanted};
  }

  // Corrects the products that a longer step would leave far too small or too large; returns false where that did not
  // help.
  bool correct_further(Change& change, double wanted_product) {
    const double now = std::min(1.0, longest(change));
    const double aim = std::min(1.0, std::max(1.5 * now, now + 0.3));
    Products products;
    for (int b = 0; b < 2; ++b) {
      const End& end = ends_[b];
      const Vector product = (end.slack + aim * change.slack[b]).cwiseProduct(end.force + aim * change.force[b]);
      products[b] =
          product.cwiseMax(kSmallestProduct * wanted_product).cwiseMin(kLargestProduct * wanted_product) - product;
      products[b] = end.exists.cwiseProduct(products[b].cwiseMax(-kLargestProduct * wanted_product));
    }
    Change further = solve(products, false);
    further.d += change.d;
    for (int b = 0; b < 2; ++b) {
      further.slack[b] += change.slack[b];
      further.force[b] += change.force[b];
    }
    if (longest(further) < now + 0.003) return false;
    change = std::move(further);
    return true;
  }

  double longest(const Change& change) const {
    double step = 2.0;
    for (int b = 0; b < 2; ++b) {
      for (int i = 0; i < values_.size(); ++i) {
        if (change.slack[b](i) < 0) step = std::min(step, -ends_[b].slack(i) / change.slack[b](i));
        if (change.force[b](i) < 0) step = std::min(step, -ends_[b].force(i) / change.force[b](i));
      }
    }
    return step;
  }

  double mean_product(const Change& change, double step) const {
    double sum = 0.0, count = 0.0;
    for (int b = 0; b < 2; ++b) {
      const End& end = ends_[b];
      sum += step == 0.0 ? end.slack.dot(end.force)
                         : (end.slack + step * change.slack[b]).dot(end.force + step * change.force[b]);
      count += end.exists.sum();
    }
    return sum / std::max(count, 1.0);
  }

  void iterate() {
    matrix_ = build_matrix();
    factor_.factorize(matrix_, limits_.held, progress_);
    factor_.forget();  // for the factor is not that of H
    auto [change, wanted_product] = predict_and_correct();
    for (int k = 0; k < kFurtherCorrectors; ++k) {
      if (longest(change) > 0.95 || !correct_further(change, wanted_product)) break;
    }
    const double step = std::min(1.0, kFractionOfLongest * longest(change));
    d_ += step * change.d;
    values_ = limits_.values(d_);
    for (int b = 0; b < 2; ++b) {
      ends_[b].slack += step * change.slack[b];
      ends_[b].force += step * change.force[b];
    }
  }

  // Returns how much more than the tolerance a function is beyond its range, or how much more than wanted the gradient
  // has left, whichever is more: at most 1 at a solution.
  double measure_error(double tolerance, double wanted) const {
    Vector left = Vector::Zero(values_.size());
    double beyond = 0.0;
    for (const End& end : ends_) {
      const Vector slack = end.sign * (values_ - end.bound);
      for (int i = 0; i < left.size(); ++i) {
        if (end.exists(i) == 0) continue;
        beyond = std::max(beyond, -slack(i));
        if (slack(i) > kTouching * tolerance) left(i) += end.sign * end.force(i);
      }
    }
    return std::max(beyond / tolerance, (limits_.pull(left).norm() + dual_residual().norm()) / wanted);
  }

  double mean_product() const { return mean_product({}, 0.0); }
  Vector present_forces() const { return ends_[0].force - ends_[1].force; }

  const QuadraticModel& model_;
  const StepLimits& limits_;
  HeldFactor& factor_;
  const Progress* progress_;
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> by_unknown_;  // n x m: the functions of each unknown; empty: A = I
  SparseMatrix matrix_;                                           // H + A^T D A
  std::array<End, 2> ends_;                                       // low, high
  Vector d_, values_;                                             // A d
};

}  // namespace

InteriorMinimum minimize_from_inside(const QuadraticModel& model, const StepLimits& limits, double extent,
                                     double tolerance, double wanted, HeldFactor& factor, const Progress* progress) {
  return InteriorPoint(model, limits, extent, factor, progress).minimize(tolerance, wanted);
}

}  // namespace reflines
