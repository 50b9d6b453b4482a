#include "optimization/contact_descent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "optimization/descent.h"
#include "optimization/wording.h"

namespace reflines {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The distance of a contact from the end of its range in tolerances.
constexpr double kTouching = 30.0;

// The tolerance of the model's solution from inside relative to the gradient that is left: the energy is no quadratic
// function.
constexpr double kModelTolerance = 0.01;

// The part of the gradient left by a step with many contacts above which no more digits are expected.
constexpr double kLeastGain = 0.9;

// The part of the gradient left by a step with a fresh model above which another matrix is assembled.
constexpr double kTrusted = 0.1;

}  // namespace

ContactDescent::ContactDescent(Problem& problem, const RowLimits& limits, const MinimizerOptions& options,
                               Progress* progress, Workspace& workspace)
    : problem_(problem),
      limits_(limits),
      options_(options),
      progress_(progress),
      work_(workspace),
      stopping_("projected gradient", gradient_, options, progress, report_) {}

Report ContactDescent::run(Vector& x) {
  try {
    if (start_near_free_minimum(x)) descend();
  } catch (const Cancelled&) {
    stopping_.is_cancelled();
  }
  finish(x);
  return report_;
}

double ContactDescent::evaluate(const Vector& x, Vector& gradient) {
  const double energy = problem_.evaluate(x, &gradient);
  for (int k = 0; k < gradient.size() && !narrow_.held.empty(); ++k) {
    if (narrow_.held[k] != Side::kBetween) gradient(k) = 0.0;
  }
  ++report_.evaluations;
  return energy;
}

// Starts with the unlimited minimum; returns false where that ends the run.
bool ContactDescent::start_near_free_minimum(const Vector& x) {
  check_start(x.size(), problem_.size());
  work_.resize(x.size());
  const int beyond = limits_.count_beyond(x);
  Vector start = x;
  if (beyond > 0) {
    narrow_ = limits_.narrow(limits_.reach(x));
    start = narrow_.pull_inside(narrow_.base, x);
    narrow_ = {};
  }
  if (limits_.are_zero()) return nothing_may_move(start, beyond);
  Vector minimum = start;
  report_ = Descent(problem_, options_, progress_, work_).run(minimum);
  report_.put_back = beyond;
  work_.x = minimum;
  current_.energy = report_.energy_after;
  gradient_.now = report_.gradient_after;
  moved_ = beyond > 0 || report_.termination != Termination::kAlreadyOptimal;
  if (report_.termination == Termination::kCancelled || limits_.contain(minimum)) return false;
  narrow_ = limits_.narrow(limits_.reach(minimum));
  if (!narrow_.may_move()) return nothing_may_move(start, beyond);
  stopping_.count_before(std::exchange(report_.iterations, 0));
  start_on_the_way(start, minimum);
  return true;
}

bool ContactDescent::nothing_may_move(const Vector& start, int put_back) {
  report_.put_back = put_back;
  report_.strategy = options_.strategy;
  report_.linear_solver = work_.solver.kind();
  report_.unknowns = problem_.size();
  work_.x = start;
  current_.energy = report_.energy_before = evaluate(work_.x, work_.gradient);
  report_.gradient_before = gradient_.now = 0.0;
  moved_ = put_back > 0;
  stopping_.stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
                 "Nothing may move: the limit is 0 at every vertex that could.");
  return false;
}

// Moves the start towards `minimum` as far as the limits allow.
void ContactDescent::start_on_the_way(const Vector& start, const Vector& minimum) {
  work_.x = narrow_.pull_inside(narrow_.base, start);
  current_.energy = evaluate(work_.x, work_.gradient);
  report_.gradient_before = work_.gradient.norm();
  gradient_.wanted = options_.gradient_tolerance * report_.gradient_before;
  work_.trial = narrow_.pull_inside(work_.x, minimum);
  const double energy = evaluate(work_.trial, work_.trial_gradient);
  moved_ = report_.put_back > 0 || energy < current_.energy;
  if (energy < current_.energy) {
    work_.x.swap(work_.trial);
    work_.gradient.swap(work_.trial_gradient);
    current_.energy = energy;
  }
  gradient_.now = work_.gradient.norm();
  work_.held = narrow_.held;
  quadratic_.emplace(narrow_, work_.held_factor, report_, progress_);
}

void ContactDescent::descend() {
  while (!stopping_.is_cancelled() && !gradient_is_small() && !stopping_.iterations_are_used_up()) {
    if (!choose_destination()) break;
    if (find_step()) {
      take_step();
    } else if (!discard_model()) {
      break;
    }
  }
}

bool ContactDescent::model_is_outdated() const {
  if (model_failed_) return true;
  if (model_is_fresh()) return false;
  if (many_contacts_) return true;
  switch (options_.strategy) {
    case Strategy::kAdaptive:
      return policy_.is_too_slow();
    case Strategy::kLinearized:
      return assembled_at_ < 0;
    case Strategy::kGaussNewton:
    case Strategy::kNewton:
      break;
  }
  return true;
}

bool ContactDescent::choose_destination() {
  if (digits_end_) return stopping_.has_no_progress(), false;
  if (many_contacts_) return (!model_is_outdated() || renew_model()) && solve_model();
  if (!model_is_outdated()) return kept_contacts_lead_on() || solve_model();
  return renew_model() && solve_model();
}

bool ContactDescent::renew_model() {
  stopping_.tell("assembling");
  work_.matrix = problem_.hessian(work_.x, choose_model(options_.strategy));
  ++report_.assemblies;
  gradient_.rounding = kEpsilon * problem_.rounding_weight(work_.matrix).cwiseProduct(work_.x).norm();
  report_.analyses += work_.analyze(work_.matrix, problem_, progress_);
  if (stopping_.is_cancelled()) return false;
  work_.factored_model = choose_model(options_.strategy);
  quadratic_->forget();
  if (!many_contacts_) {
    stopping_.tell("factorizing");
    work_.held_factor.factorize(work_.matrix, narrow_.held, progress_);
    ++report_.factorizations;
  }
  work_.memory.clear();
  assembled_at_ = report_.iterations;
  model_failed_ = false;
  policy_.start(gradient_.now, gradient_.reachable());
  return !stopping_.is_cancelled();
}

Vector ContactDescent::room(const Contacts& contacts) const {
  const Vector value = narrow_.values(work_.x);
  return quadratic_->ends(contacts, narrow_.low - value, narrow_.high - value);
}

// Tries a step with the present factor and contacts; returns false where one of these pulls, or others are needed.
bool ContactDescent::kept_contacts_lead_on() {
  stopping_.tell("iterating");
  if (!all_press_) return false;
  const Vector change = room(contacts_);
  work_.direction = -left_;
  if (learns_from_steps()) work_.memory.before_solve(work_.direction);
  work_.direction = quadratic_->step_along(contacts_, -work_.direction, change, 0.25 * narrow_.tolerance);
  if (learns_from_steps()) work_.memory.after_solve(work_.direction);
  const Vector reached = narrow_.values(work_.x + work_.direction);
  contacts_keep_ = contacts_.empty() || change.cwiseAbs().maxCoeff() <= narrow_.tolerance;
  return (reached.array() <= narrow_.high.array() + 0.5 * narrow_.tolerance).all() &&
         (reached.array() >= narrow_.low.array() - 0.5 * narrow_.tolerance).all();
}

// Determines the contacts and the step anew; returns false where these tell that the present point is the minimum.
bool ContactDescent::solve_model() {
  stopping_.tell("factorizing");
  if (!many_contacts_) {
    const Vector value = narrow_.values(work_.x);
    work_.direction = quadratic_->minimize(work_.gradient, narrow_.low - value, narrow_.high - value,
                                           0.5 * narrow_.tolerance, contacts_);
    many_contacts_ = work_.direction.size() == 0;
  }
  if (many_contacts_) solve_from_inside();
  work_.direction *= narrow_.longest_step(work_.x, work_.direction);
  work_.memory.clear();
  contacts_keep_ = false;
  measure();
  return !gradient_is_small();
}

void ContactDescent::solve_from_inside() {
  const Vector value = narrow_.values(work_.x);
  const Vector low = narrow_.low - value, high = narrow_.high - value;
  const QuadraticModel model{work_.matrix, work_.gradient};
  RowInteriorPoint inside(model, narrow_, low, high);
  const double wanted = std::max(kModelTolerance * gradient_.now, 0.3 * gradient_.wanted);
  inside.run(work_.held_factor, 0.5 * narrow_.tolerance, wanted, report_, progress_);
  work_.direction = inside.step();
  const Vector all = inside.forces(), reached = narrow_.rows.transpose() * work_.direction;
  contacts_.clear();
  std::vector<double> forces;
  for (int i = 0; i < all.size(); ++i) {
    const Side side = all(i) > 0 ? Side::kLow : Side::kHigh;
    const double way = side == Side::kLow ? reached(i) - low(i) : high(i) - reached(i);
    if (all(i) == 0 || way > kTouching * narrow_.tolerance) continue;
    contacts_.push_back({i, side});
    forces.push_back(std::abs(all(i)));
  }
  forces_ = Eigen::Map<const Vector>(forces.data(), static_cast<Eigen::Index>(forces.size()));
}

bool ContactDescent::find_step() {
  current_.slope = work_.gradient.dot(work_.direction);
  if (!(current_.slope < 0.0)) return false;
  try_step(1.0);
  return lowers_energy_enough(current_, trial_) || backtrack(current_, trial_, [this](double step) { try_step(step); });
}

void ContactDescent::try_step(double step) {
  work_.trial = work_.x + step * work_.direction;
  trial_.step = step;
  trial_.energy = evaluate(work_.trial, work_.trial_gradient);
  trial_.slope = work_.trial_gradient.dot(work_.direction);
}

void ContactDescent::take_step() {
  if (learns_from_steps() && contacts_keep_)
    work_.memory.learn(work_.trial - work_.x, work_.trial_gradient - work_.gradient);
  work_.x.swap(work_.trial);
  work_.gradient.swap(work_.trial_gradient);
  current_.energy = trial_.energy;
  const double before = gradient_.now;
  measure();
  policy_.observe(gradient_.now);
  digits_end_ = many_contacts_ && gradient_.now > kLeastGain * std::exchange(reached_norm_, gradient_.now);
  model_failed_ = model_is_fresh() && gradient_.now > kTrusted * before;
  ++report_.iterations;
  moved_ = true;
}

// Takes the contacts' forces off the gradient: of those that touch the end of their range and press.
void ContactDescent::measure() {
  const Vector way = room(contacts_);
  Contacts touching;
  std::vector<int> place;
  for (size_t i = 0; i < contacts_.size(); ++i) {
    if (std::abs(way(static_cast<Eigen::Index>(i))) > kTouching * narrow_.tolerance) continue;
    touching.push_back(contacts_[i]);
    place.push_back(static_cast<int>(i));
  }
  Vector forces(static_cast<Eigen::Index>(touching.size()));
  if (many_contacts_)
    forces = forces_(place);
  else if (!touching.empty())
    forces = quadratic_->find_forces(touching, work_.gradient);
  all_press_ = touching.empty() || forces.minCoeff() >= 0;
  left_ = quadratic_->take_off(touching, forces.cwiseMax(0.0), work_.gradient);
  gradient_.now = left_.norm();
}

bool ContactDescent::discard_model() {
  model_failed_ = !model_is_fresh();
  if (model_failed_) return true;
  stopping_.has_no_progress();
  return false;
}

void ContactDescent::finish(Vector& x) {
  report_.iterations = stopping_.steps();
  const bool moved = moved_ && report_.termination != Termination::kCancelled;
  report_.energy_after = moved ? current_.energy : report_.energy_before;
  report_.gradient_after = moved ? gradient_.now : report_.gradient_before;
  if (moved) x = work_.x;
}

bool ContactDescent::gradient_is_small() {
  if (gradient_.now > gradient_.reachable()) return false;
  return stopping_.stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
                        describe_small_gradient(gradient_.now, gradient_.reachable()));
}

}  // namespace reflines
