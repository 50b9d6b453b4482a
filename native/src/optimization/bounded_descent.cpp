#include "optimization/bounded_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "optimization/descent.h"
#include "optimization/wording.h"

namespace reflines {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The largest part of the projected gradient that a step with the kept factor may leave because the set of held
// unknowns has changed.
constexpr double kWorthwhile = 0.1;

// The tolerance of the model's solution relative to the projected gradient: the energy is no quadratic function.
constexpr double kModelTolerance = 0.01;

// The part of the projected gradient left by a step with the model above which a new matrix is assembled.
constexpr double kTrusted = 0.1;

// The cost of a new matrix and its factor, in steps with contacts: 4 with 10,000 and with 100,000 unknowns; and the
// number of steps to the last digits with it. Where 80 of 100,000 unknowns touch, a solve takes 6 steps and 4
// factorizations instead of 15 and 3 with the costs of free steps, in less time, and leaves a matrix with which each
// update of a drag takes one step, the first one, too.
constexpr int kStepsPerModel = 5, kStepsAfterModel = 1;

}  // namespace

BoundedDescent::BoundedDescent(Problem& problem, const Bounds& bounds, const MinimizerOptions& options,
                               Progress* progress, Workspace& workspace)
    : problem_(problem),
      bounds_(bounds),
      options_(options),
      progress_(progress),
      work_(workspace),
      quadratic_(workspace.held_factor, report_, progress),
      policy_(kStepsPerModel, kStepsAfterModel),
      stopping_("projected gradient", gradient_, options, progress, report_) {
  report_.strategy = options.strategy;
  report_.linear_solver = workspace.solver.kind();
  report_.unknowns = problem.size();
}

Report BoundedDescent::run(Vector& x) {
  evaluate_start(x);
  try {
    if (may_move() && (has_factor() || start_near_free_minimum())) descend();
  } catch (const Cancelled&) {
    stopping_.is_cancelled();
  }
  finish(x);
  return report_;
}

void BoundedDescent::descend() {
  while (!stopping_.is_cancelled() && !gradient_is_small() && !stopping_.iterations_are_used_up()) {
    if (!choose_destination()) break;
    if (find_step()) {
      take_step();
    } else if (!discard_model()) {
      break;
    }
  }
}

void BoundedDescent::evaluate_start(const Vector& x) {
  check_start(x.size(), problem_.size());
  work_.resize(x.size());
  work_.x = bounds_.nearest(x);
  report_.put_back = static_cast<int>((work_.x.array() != x.array()).count());
  moved_ = report_.put_back > 0;
  current_.energy = problem_.evaluate(work_.x, &work_.gradient);
  gradient_.now = bounds_.projected_norm(work_.x, work_.gradient);
  ++report_.evaluations;
  check_start(current_.energy, work_.gradient.norm());
  report_.energy_before = current_.energy;
  report_.gradient_before = gradient_.now;
  gradient_.wanted = options_.gradient_tolerance * gradient_.now;
  if (!has_factor()) return;
  measure_rounding(work_.rounding_weight);
  policy_.start(gradient_.now, gradient_.reachable());
}

bool BoundedDescent::may_move() {
  for (int k = 0; k < work_.x.size(); ++k) {
    if (!bounds_.is_point(k)) return true;
  }
  stopping_.stop(report_.put_back > 0 ? Termination::kConverged : Termination::kAlreadyOptimal,
                 "Nothing may move: the limit is 0 at every vertex that could.");
  return false;
}

// Starts with the unbounded minimum; returns false where that ends the run.
bool BoundedDescent::start_near_free_minimum() {
  const Vector start = work_.x;
  Vector minimum = start;
  Report free = Descent(problem_, options_, progress_, work_).run(minimum);
  free.put_back = report_.put_back;
  free.evaluations += report_.evaluations;
  work_.x = start;
  report_ = free;
  report_.gradient_before = gradient_.now;
  if (free.termination == Termination::kCancelled) return false;
  if (bounds_.nearest(minimum) == minimum) {
    work_.x = minimum;
    moved_ = true;
    current_.energy = free.energy_after;
    gradient_.now = free.gradient_after;
    return false;
  }
  stopping_.count_before(std::exchange(report_.iterations, 0));
  start_on_the_way_to(minimum);
  return true;
}

// Moves the start towards `minimum`, all unknowns by one factor: without the kinks of a move of each as far as it can.
void BoundedDescent::start_on_the_way_to(const Vector& minimum) {
  const Vector way = minimum - work_.x;
  double step = 1.0;
  for (int k = 0; k < way.size(); ++k) {
    if (way(k) > 0) step = std::min(step, (bounds_.high(k) - work_.x(k)) / way(k));
    if (way(k) < 0) step = std::min(step, (bounds_.low(k) - work_.x(k)) / way(k));
  }
  work_.trial = bounds_.nearest(work_.x + step * way);
  const double energy = problem_.evaluate(work_.trial, &work_.trial_gradient);
  ++report_.evaluations;
  work_.held = bounds_.touched_by(minimum);
  work_.many_contacts = false;
  if (energy < current_.energy) {
    work_.x = work_.trial;
    current_.energy = energy;
    moved_ = true;
  }
  problem_.evaluate(work_.x, &work_.gradient);
  gradient_.now = bounds_.projected_norm(work_.x, work_.gradient);
  model_failed_ = true;
}

bool BoundedDescent::model_is_outdated() const {
  if (model_failed_ || work_.matrix.rows() != work_.x.size()) return true;
  if (model_is_fresh()) return false;
  switch (options_.strategy) {
    case Strategy::kAdaptive:
      return policy_.is_too_slow() || new_model_pays();
    case Strategy::kLinearized:
      return assembled_at_ < 0;
    case Strategy::kGaussNewton:
    case Strategy::kNewton:
      break;
  }
  return true;
}

// Returns whether a new matrix at the start of this run costs no more than the matrix that is kept has cost by now.
bool BoundedDescent::new_model_pays() const {
  return assembled_at_ < 0 && report_.iterations == 0 && work_.extra_steps >= kStepsPerModel;
}

bool BoundedDescent::choose_destination() {
  if (model_is_outdated()) return renew_model() && solve_model();
  // The last run's pairs gain less than a solve: where contacts have changed, a step with them is no step to take.
  if (report_.iterations == 0) return solve_model();
  return kept_factor_leads_on() || solve_model();
}

bool BoundedDescent::renew_model() {
  stopping_.tell("assembling");
  work_.matrix = problem_.hessian(work_.x, choose_model(options_.strategy));
  work_.held_factor.forget();
  renewed_ = new_model_pays();
  work_.usual_steps = 1;
  work_.extra_steps = 0;
  ++report_.assemblies;
  measure_rounding(problem_.rounding_weight(work_.matrix));
  report_.analyses += work_.analyze(work_.matrix, problem_, progress_);
  work_.factored_model = choose_model(options_.strategy);
  assembled_at_ = report_.iterations;
  policy_.start(gradient_.now, gradient_.reachable());
  model_failed_ = false;
  return !stopping_.is_cancelled() && !gradient_is_small();
}

void BoundedDescent::measure_rounding(const Vector& weight) {
  work_.rounding_weight = weight;
  gradient_.rounding = kEpsilon * weight.cwiseProduct(work_.x).norm();
}

// Tries a step with the present factor; returns false where it leaves too much to unknowns that should be held or
// released.
bool BoundedDescent::kept_factor_leads_on() {
  stopping_.tell("iterating");
  const Bounds room = bounds_.seen_from(work_.x);
  const Vector at_bounds = room.ends(work_.held);
  work_.direction = -work_.gradient;
  if (!at_bounds.isZero(0)) work_.direction = -model().gradient_at(at_bounds);
  if (learns_from_steps()) work_.memory.before_solve(work_.direction);
  report_.solves += work_.held_factor.solve(work_.direction);
  if (learns_from_steps()) work_.memory.after_solve(work_.direction);
  work_.direction += at_bounds;
  if (measure_missed_gradient(model(), room, work_.held, work_.direction) > kWorthwhile * gradient_.now) return false;
  destination_ = bounds_.nearest(work_.x + work_.direction);
  return true;
}

bool BoundedDescent::solve_model() {
  stopping_.tell("factorizing");
  Vector d;
  const double wanted = std::max(kModelTolerance * gradient_.now, 0.3 * gradient_.wanted);
  if (!quadratic_.minimize(model(), bounds_.seen_from(work_.x), wanted, work_.held, work_.many_contacts, d))
    return stopping_.is_cancelled(), false;
  work_.memory.clear();
  destination_ = bounds_.nearest(work_.x + d);
  for (int k = 0; k < d.size(); ++k) {
    if (work_.held[k] != Side::kBetween) destination_(k) = bounds_.end(k, work_.held[k]);
  }
  return true;
}

bool BoundedDescent::find_step() {
  work_.direction = destination_ - work_.x;
  current_.slope = work_.gradient.dot(work_.direction);
  if (!(current_.slope < 0.0)) return false;
  try_step(1.0);
  return lowers_energy_enough(current_, trial_) || backtrack(current_, trial_, [this](double step) { try_step(step); });
}

void BoundedDescent::try_step(double step) {
  work_.trial = step == 1.0 ? destination_ : bounds_.nearest(work_.x + step * work_.direction);
  trial_.step = step;
  trial_.energy = problem_.evaluate(work_.trial, &work_.trial_gradient);
  trial_.slope = work_.trial_gradient.dot(work_.direction);
  ++report_.evaluations;
}

void BoundedDescent::take_step() {
  if (learns_from_steps()) {
    Vector step = work_.trial - work_.x, change = work_.trial_gradient - work_.gradient;
    bool held_move = false;
    for (int k = 0; k < step.size(); ++k) {
      if (work_.held[k] == Side::kBetween) continue;
      held_move = held_move || step(k) != 0.0;
      change(k) = 0.0;
    }
    if (!held_move) work_.memory.learn(step, change);
  }
  work_.x.swap(work_.trial);
  work_.gradient.swap(work_.trial_gradient);
  current_.energy = trial_.energy;
  const double before = std::exchange(gradient_.now, bounds_.projected_norm(work_.x, work_.gradient));
  policy_.observe(gradient_.now);
  model_failed_ = model_is_fresh() && gradient_.now > kTrusted * before;
  ++report_.iterations;
  moved_ = true;
}

bool BoundedDescent::discard_model() {
  model_failed_ = !model_is_fresh();
  if (model_failed_) return true;
  stopping_.has_no_progress();
  return false;
}

void BoundedDescent::finish(Vector& x) {
  count_steps();
  report_.iterations = stopping_.steps();
  const bool moved = moved_ && report_.termination != Termination::kCancelled;
  report_.energy_after = moved ? current_.energy : report_.energy_before;
  report_.gradient_after = moved ? gradient_.now : report_.gradient_before;
  if (moved) x = work_.x;
}

// Counts the steps that the matrix has cost beyond the usual ones: a new matrix that saved none is not paid for again.
void BoundedDescent::count_steps() {
  const int steps = report_.iterations - std::max(assembled_at_, 0);
  if (renewed_)
    work_.usual_steps = std::max(steps, 1);
  else
    work_.extra_steps += std::max(steps - work_.usual_steps, 0);
}

bool BoundedDescent::gradient_is_small() {
  const bool small = gradient_.now <= gradient_.wanted && moved_;
  if (!small && gradient_.now > gradient_.rounding) return false;
  return stopping_.stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
                        describe_small_gradient(gradient_.now, gradient_.reachable()));
}

}  // namespace reflines
