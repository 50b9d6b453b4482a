#include "optimization/bounded_quadratic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "optimization/interior_point.h"
#include "optimization/projected_relaxation.h"

namespace reflines {
namespace {

constexpr int kMaxRounds = 60;

// The sweeps of relaxation before the first factorization, from the free minimum, most of which may be beyond its
// bounds; and after each round whose set changes by more than this fraction. They save up to nine tenths of the
// factorizations.
constexpr int kFirstSweeps = 32, kSweeps = 16;
constexpr double kManyChanges = 0.2;

// The precision of an estimate from inside, relative to the extent.
constexpr double kPrecision = 1e-6;

// Returns the unknowns that a step moved beyond their bound, and of the held ones those whose multiplier has the right
// sign.
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

class BoundedQuadratic {
 public:
  BoundedQuadratic(const QuadraticModel& model, const Bounds& bounds, double wanted, HeldFactor& factor,
                   Progress* progress)
      : model_(model), bounds_(bounds), wanted_(wanted), factor_(factor), progress_(progress) {}

  BoundedMinimum minimize(Sides held, const Vector& start) {
    if (held.empty()) held = relax(start, kFirstSweeps);
    std::vector<Sides> seen;  // to find a ring; there is none for an M-matrix, which that of a bent surface is not
    bool estimated = false;
    for (int round = 0; round < kMaxRounds; ++round) {
      throw_if_cancelled(progress_);
      const Vector d = minimize_held(held), gradient = model_.gradient_at(d);
      keep_if_best(d, gradient);
      if (best_norm_ <= wanted_) break;
      Sides next = next_held(bounds_, held, d, gradient);
      const int changes = count_changes(held, next);
      if (changes == 0 && factor_.leaves_out(held)) break;
      if (changes == 0) factor_.factorize(model_.H, held, progress_);  // with the digits that the border has lost
      const bool in_ring = changes > 0 && std::find(seen.begin(), seen.end(), next) != seen.end();
      seen.push_back(next);
      if (in_ring && !estimated) {
        estimated = true;
        next = estimate_from_inside(d);
      } else if (changes > std::max<double>(HeldFactor::kMostNewColumns, kManyChanges * count_held(next))) {
        next = relax(d, kSweeps);
      }
      held = std::move(next);
    }
    return {std::move(best_), std::move(held)};
  }

 private:
  Sides relax(const Vector& d, int sweeps) {
    if (whole_.rows() == 0) whole_ = model_.H.selfadjointView<Eigen::Lower>();
    return relax_contacts(model_, whole_, bounds_, d, sweeps, progress_);
  }

  // Minimizes with the held unknowns at their bounds.
  Vector minimize_held(const Sides& held) {
    if (!factor_.hold(model_.H, held, progress_)) {
      factor_.factorize(model_.H, held, progress_);
      factor_.hold(model_.H, held, progress_);
    }
    const Vector at_bounds = bounds_.ends(held);
    Vector d = -model_.gradient_at(at_bounds);
    factor_.solve(d);
    return d + at_bounds;
  }

  // Keeps the nearest point within the bounds if its projected gradient is the smallest.
  void keep_if_best(const Vector& d, const Vector& gradient) {
    const Vector inside = bounds_.nearest(d);
    const double norm = bounds_.projected_norm(inside, inside == d ? gradient : model_.gradient_at(inside));
    if (!(norm < best_norm_)) return;
    best_norm_ = norm;
    best_ = inside;
  }

  Sides estimate_from_inside(const Vector& d) {
    const Sides points = bounds_.points();
    const double extent = std::sqrt(d.squaredNorm() / static_cast<double>(d.size()));
    const InteriorMinimum inside = minimize_from_inside(model_, {nullptr, bounds_, points}, extent, kPrecision * extent,
                                                        wanted_, factor_, progress_);
    Sides held = points;  // and those whose force is larger than the slack times their own stiffness
    for (int k = 0; k < d.size(); ++k) {
      const Side side = inside.forces(k) > 0 ? Side::kLow : Side::kHigh;
      const double way = std::abs(bounds_.end(k, side) - inside.d(k));
      if (std::abs(inside.forces(k)) > model_.H.coeff(k, k) * way) held[k] = side;
    }
    return held;
  }

  const QuadraticModel& model_;
  const Bounds& bounds_;
  double wanted_;
  HeldFactor& factor_;
  Progress* progress_;
  SparseMatrix whole_;  // H with both triangles; empty before the first relaxation
  Vector best_;
  double best_norm_ = std::numeric_limits<double>::infinity();
};

}  // namespace

BoundedMinimum minimize_bounded(const QuadraticModel& model, const Bounds& bounds, double wanted, Sides held,
                                const Vector& d, HeldFactor& factor, Progress* progress) {
  return BoundedQuadratic(model, bounds, wanted, factor, progress).minimize(std::move(held), d);
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

}  // namespace reflines
