#include "optimization/limited_descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optimization/descent.h"
#include "optimization/wording.h"

namespace reflines {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The tolerance of the model's solution relative to the gradient: the energy is no quadratic function.
constexpr double kModelTolerance = 0.01;

// The part of the gradient left by a step with the model above which a new matrix is assembled.
constexpr double kTrusted = 0.1;

// The part of the gradient left by a step with a matrix of its own above which no more digits are expected.
constexpr double kLeastGain = 0.9;

// The cost of a new matrix and its factor, in steps with contacts: 4 with 10,000 and with 100,000 unknowns; and the
// number of steps to the last digits with it.
constexpr int kStepsPerModel = 5, kStepsAfterModel = 1;

}  // namespace

LimitedDescent::LimitedDescent(Problem& problem, ActiveSet& active, const MinimizerOptions& options, Progress* progress,
                               Workspace& workspace, Report& report)
    : problem_(problem),
      active_(active),
      options_(options),
      progress_(progress),
      work_(workspace),
      report_(report),
      policy_(kStepsPerModel, kStepsAfterModel),
      stopping_("projected gradient", gradient_, options, progress, report_) {
  report_.strategy = options.strategy;
  report_.linear_solver = workspace.solver.kind();
  report_.unknowns = problem.size();
}

void LimitedDescent::run(Vector& x) {
  const int factorizations = work_.held_factor.factorizations(), solves = work_.held_factor.solves();
  evaluate_start(x);
  const bool kept = active_.has_factor(choose_model(options_.strategy));
  try {
    if (may_move() && (kept || start_near_free_minimum())) descend();
  } catch (const Cancelled&) {
    stopping_.is_cancelled();
  }
  finish(x);
  report_.factorizations += work_.held_factor.factorizations() - factorizations;
  report_.solves += work_.held_factor.solves() - solves;
}

void LimitedDescent::descend() {
  while (!stopping_.is_cancelled() && !gradient_is_small() && !stopping_.iterations_are_used_up()) {
    if (!choose_destination()) break;
    if (find_step()) {
      take_step();
    } else if (!discard_model()) {
      break;
    }
  }
}

double LimitedDescent::evaluate(const Vector& x, Vector& gradient) {
  ++report_.evaluations;
  return problem_.evaluate(x, &gradient);
}

void LimitedDescent::evaluate_start(const Vector& x) {
  check_start(x.size(), problem_.size());
  work_.resize(x.size());
  work_.x = active_.move_inside(x);
  report_.put_back = active_.count_beyond(x);
  moved_ = report_.put_back > 0;
  current_.energy = evaluate(work_.x, work_.gradient);
  check_start(current_.energy, work_.gradient.norm());
  gradient_.now = active_.measure_gradient();
  report_.energy_before = current_.energy;
  report_.gradient_before = gradient_.now;
  gradient_.wanted = options_.gradient_tolerance * gradient_.now;
  if (!active_.has_factor(choose_model(options_.strategy))) return;
  measure_rounding(work_.rounding_weight);
  policy_.start(gradient_.now, gradient_.reachable());
}

bool LimitedDescent::may_move() {
  if (active_.may_move()) return true;
  report_.gradient_before = gradient_.now = 0.0;
  stopping_.stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
                 "Nothing may move: the limit is 0 at every vertex that could.");
  return false;
}

// Starts with the free minimum; returns false where that ends the run.
bool LimitedDescent::start_near_free_minimum() {
  const Vector start = work_.x;
  Vector minimum = start;
  Report free = Descent(problem_, options_, progress_, work_).run(minimum);
  free.put_back = report_.put_back;
  free.evaluations += report_.evaluations;
  report_ = free;
  report_.gradient_before = gradient_.now;
  work_.x = start;
  if (free.termination == Termination::kCancelled) return false;
  if (active_.contain(minimum)) {
    work_.x = minimum;
    moved_ = true;
    current_.energy = free.energy_after;
    gradient_.now = free.gradient_after;
    return false;
  }
  stopping_.count_before(std::exchange(report_.iterations, 0));
  active_.aim_at(minimum);
  if (!may_move()) return false;
  start_on_the_way_to(minimum);
  return true;
}

// Moves the start towards `minimum`, all unknowns by one factor: without the kinks of a move of each as far as it can.
void LimitedDescent::start_on_the_way_to(const Vector& minimum) {
  work_.x = active_.move_inside(work_.x);
  current_.energy = evaluate(work_.x, work_.gradient);
  report_.gradient_before = gradient_.now = active_.measure_gradient();
  gradient_.wanted = options_.gradient_tolerance * gradient_.now;
  work_.trial = active_.go_towards(minimum, work_.x);
  const double energy = evaluate(work_.trial, work_.trial_gradient);
  if (energy < current_.energy) {
    work_.x.swap(work_.trial);
    work_.gradient.swap(work_.trial_gradient);
    current_.energy = energy;
    moved_ = true;
  }
  gradient_.now = active_.measure_gradient();
  model_failed_ = true;
}

bool LimitedDescent::model_is_outdated() const {
  if (model_failed_ || work_.matrix.rows() != work_.x.size()) return true;
  if (model_is_fresh()) return false;
  if (active_.renews_each_step()) return true;
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
bool LimitedDescent::new_model_pays() const {
  return assembled_at_ < 0 && report_.iterations == 0 && work_.extra_steps >= kStepsPerModel;
}

bool LimitedDescent::choose_destination() {
  if (digits_end_) return stopping_.has_no_progress(), false;
  if (model_is_outdated()) return renew_model() && solve_model();
  // The last run's pairs gain less than a solve: where contacts have changed, a step with them is no step to take.
  if (report_.iterations == 0) return solve_model();
  return kept_factor_leads_on() || solve_model();
}

bool LimitedDescent::renew_model() {
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

void LimitedDescent::measure_rounding(const Vector& weight) {
  work_.rounding_weight = weight;
  gradient_.rounding = kEpsilon * weight.cwiseProduct(work_.x).norm();
}

// Tries a step with the present factor and contacts; returns false where others are needed.
bool LimitedDescent::kept_factor_leads_on() {
  stopping_.tell("iterating");
  std::optional<Vector> end = active_.lead_on(gradient_.now, learns_from_steps() ? &work_.memory : nullptr);
  if (!end) return false;
  destination_ = std::move(*end);
  return true;
}

// Determines the contacts and the step anew; returns false where these tell that the present point is the minimum.
bool LimitedDescent::solve_model() {
  stopping_.tell("factorizing");
  destination_ = active_.solve_model(std::max(kModelTolerance * gradient_.now, 0.3 * gradient_.wanted));
  work_.memory.clear();
  gradient_.now = active_.measure_gradient();
  return !gradient_is_small();
}

bool LimitedDescent::find_step() {
  work_.direction = destination_ - work_.x;
  current_.slope = work_.gradient.dot(work_.direction);
  if (!(current_.slope < 0.0)) return false;
  try_step(1.0);
  return lowers_energy_enough(current_, trial_) || backtrack(current_, trial_, [this](double step) { try_step(step); });
}

void LimitedDescent::try_step(double step) {
  work_.trial = step == 1.0 ? destination_ : active_.keep_inside(work_.x + step * work_.direction);
  trial_.step = step;
  trial_.energy = evaluate(work_.trial, work_.trial_gradient);
  trial_.slope = work_.trial_gradient.dot(work_.direction);
}

void LimitedDescent::take_step() {
  if (learns_from_steps()) {
    const Vector step = work_.trial - work_.x;
    const Vector change = work_.trial_gradient - work_.gradient;
    if (active_.keeps_contacts()) work_.memory.learn(step, change);
  }
  work_.x.swap(work_.trial);
  work_.gradient.swap(work_.trial_gradient);
  current_.energy = trial_.energy;
  const double before = std::exchange(gradient_.now, active_.measure_gradient());
  policy_.observe(gradient_.now);
  digits_end_ = active_.renews_each_step() && gradient_.now > kLeastGain * std::exchange(reached_norm_, gradient_.now);
  model_failed_ = model_is_fresh() && gradient_.now > kTrusted * before;
  ++report_.iterations;
  moved_ = true;
}

bool LimitedDescent::discard_model() {
  model_failed_ = !model_is_fresh();
  if (model_failed_) return true;
  stopping_.has_no_progress();
  return false;
}

void LimitedDescent::finish(Vector& x) {
  count_steps();
  report_.iterations = stopping_.steps();
  const bool moved = moved_ && report_.termination != Termination::kCancelled;
  report_.energy_after = moved ? current_.energy : report_.energy_before;
  report_.gradient_after = moved ? gradient_.now : report_.gradient_before;
  if (moved) x = work_.x;
}

// Counts the steps that the matrix has cost beyond the usual ones: a new matrix that saved none is not paid for again.
void LimitedDescent::count_steps() {
  const int steps = report_.iterations - std::max(assembled_at_, 0);
  if (renewed_)
    work_.usual_steps = std::max(steps, 1);
  else
    work_.extra_steps += std::max(steps - work_.usual_steps, 0);
}

bool LimitedDescent::gradient_is_small() {
  const bool small = gradient_.now <= gradient_.wanted && moved_;
  if (!small && gradient_.now > gradient_.rounding) return false;
  return stopping_.stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
                        describe_small_gradient(gradient_.now, gradient_.reachable()));
}

}  // namespace reflines
