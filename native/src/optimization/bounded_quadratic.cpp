#include "optimization/bounded_quadratic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "optimization/interior_point.h"

namespace reflines {
namespace {

constexpr int kMaxRounds = 60;

// The cost of the interior point method in rounds of the active set method.
constexpr double kRoundsOfInteriorPoint = 9.0;
constexpr int kMaxInteriorSteps = 15;

// Returns whether many rounds are left until the set no longer changes, if the number of changes goes on falling at its
// present rate.
bool settles_slowly(int changes_before, int changes) {
  if (changes <= 1) return false;
  const double digits_a_round = std::log(static_cast<double>(changes_before) / changes);
  return std::log(changes) > kRoundsOfInteriorPoint * digits_a_round;
}

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

bool BoundedQuadratic::minimize(const QuadraticModel& model, const Bounds& bounds, double wanted, Sides& held,
                                Vector& d) {
  best_norm_ = std::numeric_limits<double>::infinity();
  int changes = 0, slow_rounds = 0;
  bool guessed = false;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (cancelled()) return false;
    const Vector trial = solve_held(model, bounds, held);
    keep_if_best(model, bounds, trial, d);
    if (best_norm_ <= wanted) return true;
    Sides next = next_held(bounds, held, trial, model.gradient_at(trial));
    const int changes_before = std::exchange(changes, count_changes(held, next));
    if (changes == 0) return true;
    slow_rounds = round > 0 && settles_slowly(changes_before, changes) ? slow_rounds + 1 : 0;
    if (slow_rounds >= 2 && !guessed) {
      guessed = true;
      if (!guess_from_inside(model, bounds, std::sqrt(trial.squaredNorm() / trial.size()), next)) return false;
    }
    held = std::move(next);
  }
  return true;
}

Vector BoundedQuadratic::solve_held(const QuadraticModel& model, const Bounds& bounds, const Sides& held) {
  const Vector at_bounds = bounds.ends(held);
  factor_.factorize(model.H, held);
  Vector d = -model.gradient_at(at_bounds);
  factor_.solve(held, d);
  ++counts_.factorizations;
  ++counts_.solves;
  return d + at_bounds;
}

bool BoundedQuadratic::keep_if_best(const QuadraticModel& model, const Bounds& bounds, const Vector& d, Vector& best) {
  const Vector inside = bounds.nearest(d);
  const double norm = bounds.projected_norm(inside, model.gradient_at(inside));
  if (!(norm < best_norm_)) return false;
  best_norm_ = norm;
  best = inside;
  return true;
}

bool BoundedQuadratic::guess_from_inside(const QuadraticModel& model, const Bounds& bounds, double reach, Sides& held) {
  InteriorPoint inside(model, bounds, reach);
  for (int step = 0; step < kMaxInteriorSteps; ++step) {
    if (cancelled()) return false;
    if (!inside.step(factor_, counts_)) break;
  }
  held = inside.guess();
  return true;
}

}  // namespace reflines
