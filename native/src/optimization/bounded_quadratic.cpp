#include "optimization/bounded_quadratic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/union_find.h"
#include "optimization/interior_point.h"
#include "optimization/projected_relaxation.h"

namespace reflines {
namespace {

constexpr int kMaxRounds = 60, kMaxSearches = 60;

// The rounds within which a search of contacts must halve the projected gradient, or the changes of the set: with
// hundreds of contacts these fell from 46 to 5 while the gradient of the best point stayed.
constexpr int kPatience = 8;

// Returns the number of contacts above which the search of contacts ends; it does not begin with larger estimates
// either. They are few of all unknowns, too: with 1,000 of 900, two of 100 random solves with free borders did not
// converge.
int few_contacts(const Sides& all) { return std::min<int>(1000, static_cast<int>(all.size()) / 10); }

// The violation below which a peak is not yet held, relative to the largest, where there are many: most of these vanish
// with the larger ones.
constexpr double kLeastViolation = 0.05;
constexpr int kManyPeaks = 16;

// The sweeps of relaxation before the first factorization, from the free minimum, most of which may be beyond its
// bounds; and after each round whose set changes by more than this fraction. They save up to nine tenths of the
// factorizations.
constexpr int kFirstSweeps = 32, kSweeps = 16;
constexpr double kManyChanges = 0.2;

// Finds that active sets follow each other in a ring, by Brent's method (BIT 20, 1980): each is compared with that of
// the last round whose number is a power of two. There are no rings for an M-matrix, which that of a bent surface is
// not.
class Ring {
 public:
  bool is_closed_by(const Sides& held) {
    if (held == kept_) return true;
    ++round_;
    if ((round_ & (round_ - 1)) == 0) kept_ = held;
    return false;
  }

 private:
  Sides kept_;
  int round_ = 0;
};

}  // namespace

Sides next_held(const Bounds& bounds, const Sides& held, const Vector& d, const Vector& gradient) {
  Sides next(held.size(), Side::kBetween);
  for (int k = 0; k < d.size(); ++k) {
    const bool pressed = (held[k] == Side::kLow && gradient(k) > 0) || (held[k] == Side::kHigh && gradient(k) < 0);
    if (bounds.is_point(k))
      next[k] = Side::kLow;
    else if (held[k] != Side::kBetween)
      next[k] = pressed ? held[k] : Side::kBetween;
    else if (d(k) < bounds.low(k))
      next[k] = Side::kLow;
    else if (d(k) > bounds.high(k))
      next[k] = Side::kHigh;
  }
  return next;
}

double measure_missed_gradient(const QuadraticModel& model, const Bounds& bounds, const Sides& held, const Vector& d) {
  const Vector inside = bounds.nearest(d);
  const Vector cut = model.H.selfadjointView<Eigen::Lower>() * (inside - d);
  const Vector gradient = model.gradient_at(inside);
  double squared = 0.0;
  for (int k = 0; k < d.size(); ++k) {
    if (bounds.is_point(k)) continue;
    double entry = held[k] == Side::kBetween ? cut(k) : gradient(k);
    if (held[k] == Side::kLow) entry = std::min(entry, 0.0);
    if (held[k] == Side::kHigh) entry = std::max(entry, 0.0);
    squared += entry * entry;
  }
  return std::sqrt(squared);
}

Sides keep_peaks(const SparseMatrix& H, const Bounds& bounds, const Sides& held, const Sides& next, const Vector& d) {
  const Vector beyond = (d - bounds.nearest(d)).cwiseAbs();
  UnionFind patches(static_cast<int>(beyond.size()));
  for (int column = 0; column < H.outerSize(); ++column) {
    if (!(beyond(column) > 0)) continue;
    for (SparseMatrix::InnerIterator entry(H, column); entry; ++entry) {
      if (beyond(entry.row()) > 0) patches.unite(column, static_cast<int>(entry.row()));
    }
  }
  const auto is_new = [&](int k) { return held[k] == Side::kBetween && next[k] != Side::kBetween; };
  std::vector<int> peak(next.size(), -1);  // of each patch, at its root
  for (int k = 0; k < static_cast<int>(next.size()); ++k) {
    int& highest = peak[patches.find(k)];
    if (is_new(k) && (highest < 0 || beyond(k) > beyond(highest))) highest = k;
  }
  double most = 0.0;
  int count = 0;
  for (const int k : peak) {
    if (k < 0) continue;
    most = std::max(most, beyond(k));
    ++count;
  }
  const double least = count > kManyPeaks ? kLeastViolation * most : 0.0;
  Sides result = next;
  for (int k = 0; k < static_cast<int>(next.size()); ++k) {
    if (is_new(k) && (peak[patches.find(k)] != k || beyond(k) < least)) result[k] = Side::kBetween;
  }
  return result;
}

BoundedQuadratic::BoundedQuadratic(const QuadraticModel& model, const Bounds& bounds, double wanted, HeldFactor& factor,
                                   Report& counts, Progress* progress)
    : model_(model),
      bounds_(bounds),
      wanted_(wanted),
      factor_(factor),
      counts_(counts),
      progress_(progress),
      points_(bounds.points()) {}

bool BoundedQuadratic::is_few(const Sides& held) const {
  return count_held(held) <= few_contacts(held) + count_held(points_);
}

BoundedQuadratic::Minimum BoundedQuadratic::minimize(Sides held, bool many) {
  ProjectedRelaxation relaxation(model_, bounds_, progress_);
  if (!many) {
    if (const std::optional<Sides> few = search_contacts(is_few(held) ? held : points_)) return {best_, *few, false};
    if (!is_few(held)) held = relaxation.estimate_held(best_, kFirstSweeps);
  }
  held = settle(relaxation, std::move(held));
  return {best_, std::move(held), true};
}

// Returns nothing where there are too many contacts.
std::optional<Sides> BoundedQuadratic::search_contacts(Sides held) {
  std::vector<double> norms;
  std::vector<int> changes;
  for (int round = 0; round < kMaxSearches; ++round) {
    throw_if_cancelled(progress_);
    held = release_pulling(std::move(held));
    const Trial trial = minimize_held(held);
    const Sides next = keep_peaks(model_.H, bounds_, held, next_held(bounds_, held, trial.d, trial.gradient), trial.d);
    const bool settled = next == held;
    if (best_norm_ <= wanted_ || (settled && factor_.leaves_out(held))) return held;
    if (settled) factorize(held);  // which has the digits that the Schur complement lost
    norms.push_back(best_norm_);
    changes.push_back(count_changes(held, next));
    const bool slow = round >= kPatience && norms[round] > 0.5 * norms[round - kPatience] &&
                      2 * changes[round] > changes[round - kPatience];
    if (slow || !is_few(next)) break;
    held = next;
  }
  return {};
}

Sides BoundedQuadratic::settle(ProjectedRelaxation& relaxation, Sides held) {
  Ring ring;
  bool estimated = false;
  for (int round = 0; round < kMaxRounds; ++round) {
    throw_if_cancelled(progress_);
    const Trial trial = minimize_held(held);
    if (best_norm_ <= wanted_) break;
    Sides next = next_held(bounds_, held, trial.d, trial.gradient);
    const bool few = is_few(next);
    if (few) next = keep_peaks(model_.H, bounds_, held, next, trial.d);
    const int changes = count_changes(held, next);
    if (changes == 0 && factor_.leaves_out(held)) break;
    if (changes == 0) factorize(held);  // which has the digits that the Schur complement lost
    const bool in_ring = changes > 0 && ring.is_closed_by(next);
    if (in_ring && !estimated) {
      estimated = true;
      next = estimate_from_inside(std::sqrt(trial.d.squaredNorm() / static_cast<double>(trial.d.size())));
    } else if (!few && changes > std::max<double>(HeldFactor::kMostNewColumns, kManyChanges * count_held(next))) {
      next = relaxation.estimate_held(trial.d, kSweeps);
    }
    held = std::move(next);
  }
  return held;
}

void BoundedQuadratic::factorize(const Sides& held) {
  factor_.factorize(model_.H, held, progress_);
  ++counts_.factorizations;
}

void BoundedQuadratic::hold(const Sides& held) {
  std::optional<int> solves = factor_.hold(model_.H, held, progress_);
  if (!solves) {
    const bool few = count_held(held) - count_held(points_) <= HeldFactor::kMostNewColumns;
    factorize(few ? points_ : held);
    solves = factor_.hold(model_.H, held, progress_);
  }
  counts_.solves += solves.value_or(0);
}

// Minimizes with the held unknowns at their bounds.
BoundedQuadratic::Trial BoundedQuadratic::minimize_held(const Sides& held) {
  hold(held);
  Trial trial = solve_held(held);
  keep_if_best(trial);
  return trial;
}

// Releases contacts that pull at their bounds until none does.
Sides BoundedQuadratic::release_pulling(Sides held) {
  if (!factor_.tells_forces()) return held;
  hold(held);
  const Vector at_bounds = bounds_.ends(held), right = right_side(factor_.select_left_out(at_bounds));
  bool pulls = true;
  while (pulls) {
    pulls = false;
    const Vector forces = factor_.find_forces(right, at_bounds);
    for (Eigen::Index i = 0; i < forces.size(); ++i) {
      const int k = factor_.contacts()[i];
      const bool presses = held[k] == Side::kLow ? forces(i) < 0 : forces(i) > 0;
      if (presses || bounds_.is_point(k)) continue;
      held[k] = Side::kBetween;
      pulls = true;
    }
    if (pulls) hold(held);
  }
  return held;
}

Vector BoundedQuadratic::right_side(const Vector& left_out) const {
  return left_out.isZero(0) ? Vector(-model_.gradient) : Vector(-model_.gradient_at(left_out));
}

BoundedQuadratic::Trial BoundedQuadratic::solve_held(const Sides& held) {
  const Vector at_bounds = bounds_.ends(held), left_out = factor_.select_left_out(at_bounds);
  Vector d = right_side(left_out);
  counts_.solves += factor_.solve(d, at_bounds);
  d += left_out;
  return {d, model_.gradient_at(d)};
}

// Keeps the nearest point within the bounds if its projected gradient is the smallest.
void BoundedQuadratic::keep_if_best(const Trial& trial) {
  const Vector inside = bounds_.nearest(trial.d);
  const double norm = bounds_.projected_norm(inside, inside == trial.d ? trial.gradient : model_.gradient_at(inside));
  if (!(norm < best_norm_)) return;
  best_norm_ = norm;
  best_ = inside;
}

Sides BoundedQuadratic::estimate_from_inside(double extent) {
  const StepLimits limits{nullptr, bounds_.low, bounds_.high, points_};
  return InteriorPoint(model_, limits, extent, factor_, counts_, progress_).estimate_held();
}

}  // namespace reflines
