#include "optimization/descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimization/wording.h"

namespace reflines {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The limit of trials of a line search: each at least halves the step, and after 40 it has vanished.
constexpr int kMaxTrials = 40;

}  // namespace

Descent::Descent(Problem& problem, const MinimizerOptions& options, Progress* progress, Workspace& workspace)
    : problem_(problem), options_(options), progress_(progress), work_(workspace) {
  report_.strategy = options.strategy;
  report_.linear_solver = workspace.solver.kind();
  report_.unknowns = problem.size();
}

Report Descent::run(Vector& x) {
  evaluate_start(x);
  try {
    approach();
    descend();
  } catch (const Cancelled&) {
    is_cancelled();
  }
  finish(x);
  return report_;
}

void Descent::descend() {
  while (!is_cancelled() && !gradient_is_small() && !iterations_are_used_up()) {
    if (factor_is_outdated() && !renew_factor()) break;
    choose_direction();
    if (step_is_rounding()) break;
    if (find_step()) {
      take_step();
    } else if (!discard_factor()) {
      break;
    }
  }
}

void Descent::evaluate_start(const Vector& x) {
  check_start(x.size(), problem_.size());
  work_.resize(x.size());
  work_.x = x;
  current_.energy = problem_.evaluate(work_.x, &work_.gradient);
  gradient_norm_ = work_.gradient.norm();
  ++report_.evaluations;
  check_start(current_.energy, gradient_norm_);
  report_.energy_before = current_.energy;
  report_.gradient_before = gradient_norm_;
  wanted_gradient_norm_ = options_.gradient_tolerance * gradient_norm_;
  if (!factor_is_kept()) return;
  measure_rounding(work_.rounding_weight);
  policy_.start(gradient_norm_, std::max(wanted_gradient_norm_, gradient_rounding_));
}

void Descent::measure_rounding(const Vector& weight) {
  work_.rounding_weight = weight;
  gradient_rounding_ = kEpsilon * weight.cwiseProduct(work_.x).norm();
}

void Descent::finish(Vector& x) {
  const bool moved = report_.termination != Termination::kCancelled && has_moved();
  report_.energy_after = moved ? current_.energy : report_.energy_before;
  report_.gradient_after = moved ? gradient_norm_ : report_.gradient_before;
  if (moved) x = work_.x;
}

bool Descent::factor_is_kept() const { return work_.has_factor_of(choose_model(options_.strategy), work_.x.size()); }

bool Descent::factor_is_outdated() const {
  if (!factor_is_kept() || factor_failed_) return true;
  if (factor_is_fresh()) return false;
  switch (options_.strategy) {
    case Strategy::kAdaptive:
      return policy_.is_too_slow();
    case Strategy::kLinearized:
      return factored_at_ < 0;  // weights may have changed since the solve before
    case Strategy::kGaussNewton:
    case Strategy::kNewton:
      break;
  }
  return true;
}

bool Descent::renew_factor() {
  tell("assembling");
  const SparseMatrix& hessian = problem_.hessian(work_.x, choose_model(options_.strategy));
  ++report_.assemblies;
  measure_rounding(problem_.rounding_weight(hessian));
  if (gradient_is_rounding() || is_cancelled()) return false;
  if (!work_.solver.has_pattern_of(hessian)) tell("ordering");
  analyze(hessian);
  if (is_cancelled()) return false;
  tell("factorizing");
  work_.solver.factorize(hessian, progress_);
  ++report_.factorizations;
  work_.factored_model = choose_model(options_.strategy);
  work_.held.clear();
  work_.held_factor.forget();
  work_.memory.clear();
  factored_at_ = report_.iterations;
  factor_failed_ = false;
  policy_.start(gradient_norm_, std::max(wanted_gradient_norm_, gradient_rounding_));
  return !is_cancelled();
}

void Descent::analyze(const SparseMatrix& matrix) { report_.analyses += work_.analyze(matrix, problem_, progress_); }

void Descent::choose_direction() {
  tell("iterating");
  work_.direction = -work_.gradient;
  if (learns_from_steps()) work_.memory.before_solve(work_.direction);
  work_.solver.solve(work_.direction);
  ++report_.solves;
  if (learns_from_steps()) work_.memory.after_solve(work_.direction);
  current_.slope = work_.gradient.dot(work_.direction);
}

// Finds a step that lowers the energy enough. Where a full step with an old factor is refused, the factor is wrong at
// this point, and a shorter step would make little progress: the search fails at once.
bool Descent::find_step() {
  if (!(current_.slope < 0.0)) return false;
  try_step(1.0);
  if (lowers_energy_enough(current_, trial_)) return true;
  return (factor_is_fresh() || !learns_from_steps()) && backtrack();
}

bool Descent::backtrack() {
  for (int trial = 1; trial < kMaxTrials; ++trial) {
    try_step(shorter_step(current_, trial_));
    if (lowers_energy_enough(current_, trial_)) return true;
  }
  return false;
}

void Descent::try_step(double step) {
  work_.trial.noalias() = work_.x + step * work_.direction;
  trial_.step = step;
  trial_.energy = problem_.evaluate(work_.trial, &work_.trial_gradient);
  trial_.slope = work_.trial_gradient.dot(work_.direction);
  ++report_.evaluations;
}

void Descent::take_step() {
  if (learns_from_steps()) {
    work_.direction *= trial_.step;
    work_.gradient = work_.trial_gradient - work_.gradient;
    work_.memory.learn(work_.direction, work_.gradient);
  }
  accept_trial();
  policy_.observe(gradient_norm_);
  ++report_.iterations;
}

void Descent::accept_trial() {
  work_.x.swap(work_.trial);
  work_.gradient.swap(work_.trial_gradient);
  current_.energy = trial_.energy;
  gradient_norm_ = work_.gradient.norm();
}

bool Descent::discard_factor() {
  factor_failed_ = learns_from_steps() && !factor_is_fresh();
  if (factor_failed_) return true;
  stop(Termination::kNoProgress,
       format_sentence("No step lowers the energy any further: the gradient is %.3g where %.3g was wanted.",
                       gradient_norm_, wanted_gradient_norm_));
  return false;
}

bool Descent::is_cancelled() {
  if (progress_ == nullptr || !progress_->cancelled()) return false;
  return stop(Termination::kCancelled,
              format_sentence("Cancelled after %.0f steps with the gradient at %.3g; nothing was changed.",
                              report_.iterations, gradient_norm_));
}

bool Descent::gradient_is_small() {
  if (gradient_norm_ > wanted_gradient_norm_ || !has_moved()) return gradient_is_rounding();
  return stop(Termination::kConverged,
              format_sentence("The gradient is down to %.3g; %.3g was wanted.", gradient_norm_, wanted_gradient_norm_));
}

bool Descent::gradient_is_rounding() {
  if (gradient_norm_ > gradient_rounding_) return false;
  const bool untouched = !has_moved();
  return stop(
      untouched ? Termination::kAlreadyOptimal : Termination::kConverged,
      format_sentence(
          untouched ? "Nothing to do: the gradient of the start, %.3g, does not exceed its rounding error of %.3g."
                    : "The gradient is down to %.3g, which does not exceed its rounding error of %.3g.",
          gradient_norm_, gradient_rounding_));
}

bool Descent::step_is_rounding() {
  const double largest_step = work_.direction.lpNorm<Eigen::Infinity>();
  const double resolution = kEpsilon * work_.x.lpNorm<Eigen::Infinity>();
  if (!(largest_step <= resolution)) return false;
  return stop(
      !has_moved() ? Termination::kAlreadyOptimal : Termination::kConverged,
      format_sentence("The next step would move nothing by more than %.3g, below the resolution %.3g of the unknowns.",
                      largest_step, resolution));
}

bool Descent::iterations_are_used_up() {
  if (report_.iterations < options_.max_iterations) return false;
  return stop(Termination::kIterationLimit,
              format_sentence(("The limit of " + std::to_string(options_.max_iterations) +
                               " steps was reached with the gradient at %.3g where %.3g was wanted.")
                                  .c_str(),
                              gradient_norm_, wanted_gradient_norm_));
}

bool Descent::stop(Termination termination, const std::string& message) {
  report_.termination = termination;
  report_.message = message;
  return true;
}

void Descent::tell(const char* stage) {
  report_digits(progress_, stage, report_.gradient_before, gradient_norm_,
                std::max(wanted_gradient_norm_, gradient_rounding_));
}

}  // namespace reflines
