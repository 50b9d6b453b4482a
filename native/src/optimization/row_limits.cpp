#include "optimization/row_limits.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "reflines/errors.h"

namespace reflines {
namespace {

// The tolerance relative to the size of the moves: with a tenth of it 4 of 150 random solves stopped for lack of
// digits.
constexpr double kTolerance = 1e-8;

// The least tolerance relative to the values that the functions would have: what a model's solution can keep.
constexpr double kPrecision = 1e-9;

// The fraction of a function that narrow limits, in tolerances, take from either side before it cannot move at all: the
// base is two tolerances from the origin, and the narrow limits are one tolerance within the limits.
constexpr double kNoRoom = 3.0;
constexpr double kBaseMove = 2.0;

// The part of the tolerance that a step may end beyond the narrow limits: more than the half that models keep, and less
// than all, for rounding.
constexpr double kBeyond = 0.75;

using Entries = std::pair<const int*, const double*>;

bool comes_before(const SparseMatrix& rows, int a, int b) {
  const int count_a = rows.outerIndexPtr()[a + 1] - rows.outerIndexPtr()[a];
  const int count_b = rows.outerIndexPtr()[b + 1] - rows.outerIndexPtr()[b];
  if (count_a != count_b) return count_a < count_b;
  const int *unknown_a = rows.innerIndexPtr() + rows.outerIndexPtr()[a],
            *unknown_b = rows.innerIndexPtr() + rows.outerIndexPtr()[b];
  const auto [first_a, first_b] = std::mismatch(unknown_a, unknown_a + count_a, unknown_b);
  if (first_a != unknown_a + count_a) return *first_a < *first_b;
  const double *weight_a = rows.valuePtr() + rows.outerIndexPtr()[a],
               *weight_b = rows.valuePtr() + rows.outerIndexPtr()[b];
  return std::lexicographical_compare(weight_a, weight_a + count_a, weight_b, weight_b + count_b);
}

// Returns the column of `rows` that stands for each (#columns), the first of those that are equal.
std::vector<int> find_equal_columns(const SparseMatrix& rows) {
  std::vector<int> order(rows.cols()), leader(rows.cols());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return comes_before(rows, a, b); });
  for (size_t k = 0; k < order.size(); ++k) {
    const bool equal = k > 0 && !comes_before(rows, order[k - 1], order[k]);
    leader[order[k]] = equal ? leader[order[k - 1]] : order[k];
  }
  return leader;
}

// A matrix without the rows of held unknowns, whose columns sum to 1 where they are not empty, and what they summed to.
struct Means {
  SparseMatrix rows;
  Vector sum;
};
Means take_means(const SparseMatrix& modes, const Sides& held) {
  SparseMatrix rows = modes;
  rows.prune(
      [&](Eigen::Index unknown, Eigen::Index, double weight) { return weight > 0 && held[unknown] == Side::kBetween; });
  Vector sum = rows.transpose() * Vector::Ones(rows.rows());
  for (int i = 0; i < rows.cols(); ++i) {
    for (SparseMatrix::InnerIterator entry(rows, i); entry; ++entry) entry.valueRef() /= sum(i);
  }
  return {std::move(rows), std::move(sum)};
}

// Tells of each unknown (n) whether it moves a function that can grow only, or that can fall only.
struct Directions {
  Mask up, down;
};
Directions find_directions(const SparseMatrix& rows, const Vector& low, const Vector& high, double room) {
  Mask up = Mask::Constant(rows.rows(), false), down = up;
  for (int i = 0; i < rows.cols(); ++i) {
    for (SparseMatrix::InnerIterator entry(rows, i); entry; ++entry) {
      if (low(i) > -room) up(entry.row()) = true;
      if (high(i) < room) down(entry.row()) = true;
    }
  }
  return {std::move(up), std::move(down)};
}

}  // namespace

SparseMatrix select_columns(const SparseMatrix& matrix, const std::vector<int>& columns) {
  SparseMatrix result(matrix.rows(), static_cast<Eigen::Index>(columns.size()));
  for (size_t j = 0; j < columns.size(); ++j) {
    result.startVec(static_cast<Eigen::Index>(j));
    for (SparseMatrix::InnerIterator entry(matrix, columns[j]); entry; ++entry)
      result.insertBack(entry.row(), static_cast<Eigen::Index>(j)) = entry.value();
  }
  result.finalize();
  return result;
}

RowLimits::RowLimits(const SparseMatrix& modes, Vector low, Vector high, Vector origin, double rounding)
    : modes_(&modes), range_{std::move(low), std::move(high)}, origin_(std::move(origin)), rounding_(rounding) {
  if (modes.nonZeros() == 0 || modes.coeffs().minCoeff() >= 0) return;
  throw InvalidInput("A limit of the move needs a surface whose vertices follow the unknowns by weights of 0 or more.");
}

RowLimits::RowLimits(const Bounds& bounds) : range_(bounds), origin_(Vector::Zero(bounds.low.size())) {}

Vector RowLimits::values(const Vector& x) const { return are_bounds() ? x : modes_->transpose() * (x - origin_); }

bool RowLimits::contain(const Vector& x) const {
  const Vector all = values(x);
  for (int i = 0; i < all.size(); ++i) {
    const double rounding = all(i) == 0 ? 0.0 : rounding_;
    if (all(i) > range_.high(i) - rounding || all(i) < range_.low(i) + rounding) return false;
  }
  return true;
}

int RowLimits::count_beyond(const Vector& x) const {
  const Vector all = values(x);
  int count = 0;
  for (int i = 0; i < all.size(); ++i) count += all(i) > range_.high(i) || all(i) < range_.low(i);
  return count;
}

double RowLimits::choose_tolerance(double extent) const {
  const double limit = range_.low.size() > 0 ? std::max(largest_finite(range_.low), largest_finite(range_.high)) : 0.0;
  const double size = limit > 0 ? std::min(limit, extent) : extent;
  return std::max({kTolerance * size, kPrecision * extent, 4 * rounding_});
}

RowLimits::Narrow RowLimits::narrow(double extent) const {
  if (are_bounds()) {
    SparseMatrix identity(range_.low.size(), range_.low.size());
    identity.setIdentity();
    return {std::move(identity), true, range_, origin_, 0.0, range_.points(), {}};
  }
  Narrow result;
  result.tolerance = choose_tolerance(extent);
  result.origin = origin_;
  result.held.assign(modes_->rows(), Side::kBetween);
  const Means all = take_means(*modes_, result.held);
  const Directions only = find_directions(all.rows, range_.low.cwiseQuotient(all.sum),
                                          range_.high.cwiseQuotient(all.sum), kNoRoom * result.tolerance);
  for (int k = 0; k < only.up.size(); ++k) {
    if (only.up(k) && only.down(k)) result.held[k] = Side::kLow;
  }
  auto [rows, sum] = take_means(*modes_, result.held);
  result.rows = std::move(rows);
  result.range.low = (range_.low.cwiseQuotient(sum).array() + result.tolerance).matrix();
  result.range.high = (range_.high.cwiseQuotient(sum).array() - result.tolerance).matrix();
  result.merge_equal(sum);
  const auto [up, down] =
      find_directions(result.rows, result.range.low, result.range.high, kBaseMove * result.tolerance);
  result.base = origin_ + kBaseMove * result.tolerance * (up.cast<double>() - down.cast<double>()).matrix();
  return result;
}

// Leaves one of functions that are equal, and none of those that are empty (sum 0) or have no limit.
void RowLimits::Narrow::merge_equal(const Vector& sum) {
  const std::vector<int> leader = find_equal_columns(rows);
  for (int i = 0; i < rows.cols(); ++i) {
    range.low(leader[i]) = std::max(range.low(leader[i]), range.low(i));
    range.high(leader[i]) = std::min(range.high(leader[i]), range.high(i));
  }
  std::vector<int> kept;
  for (int i = 0; i < rows.cols(); ++i) {
    if (leader[i] == i && sum(i) > 0 && (std::isfinite(range.low(i)) || std::isfinite(range.high(i))))
      kept.push_back(i);
  }
  rows = select_columns(rows, kept);
  range.low = Vector(range.low(kept));
  range.high = Vector(range.high(kept));
}

Vector RowLimits::Narrow::pull_inside(const Vector& from, const Vector& to) const {
  Vector end = to;
  for (int k = 0; k < end.size(); ++k) {
    if (held[k] != Side::kBetween) end(k) = from(k);
  }
  const Vector first = values(from), last = values(end);
  double fraction = 1.0;
  for (int i = 0; i < last.size(); ++i) {
    if (last(i) > range.high(i)) fraction = std::min(fraction, (range.high(i) - first(i)) / (last(i) - first(i)));
    if (last(i) < range.low(i)) fraction = std::min(fraction, (range.low(i) - first(i)) / (last(i) - first(i)));
  }
  return clip(fraction == 1.0 ? end : Vector(from + std::max(fraction, 0.0) * (end - from)));
}

Vector RowLimits::Narrow::end_step(const Vector& x, const Vector& step) const {
  if (are_bounds) return clip(x + step);
  const Vector first = values(x), way = rows.transpose() * step;
  const double beyond = kBeyond * tolerance;
  double part = 1.0;
  for (int i = 0; i < way.size(); ++i) {
    if (first(i) + way(i) > range.high(i) + beyond) part = std::min(part, (range.high(i) + beyond - first(i)) / way(i));
    if (first(i) + way(i) < range.low(i) - beyond) part = std::min(part, (range.low(i) - beyond - first(i)) / way(i));
  }
  return x + std::max(part, 0.0) * step;
}

}  // namespace reflines
