#include "optimization/descent.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimization/wording.h"

namespace reflines {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

}  // namespace

Descent::Descent(Problem& problem, const MinimizerOptions& options, Progress* progress, Workspace& workspace)
    : problem_(problem),
      options_(options),
      progress_(progress),
      work_(workspace),
      stopping_("gradient", gradient_, options, progress, report_) {
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
    stopping_.is_cancelled();
  }
  finish(x);
  return report_;
}

void Descent::descend() {
  while (!stopping_.is_cancelled() && !gradient_is_small() && !stopping_.iterations_are_used_up()) {
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
  gradient_.now = work_.gradient.norm();
  ++report_.evaluations;
  check_start(current_.energy, gradient_.now);
  report_.energy_before = current_.energy;
  report_.gradient_before = gradient_.now;
  gradient_.wanted = options_.gradient_tolerance * gradient_.now;
  if (!factor_is_kept()) return;
  measure_rounding(work_.rounding_weight);
  policy_.start(gradient_.now, gradient_.reachable());
}

void Descent::measure_rounding(const Vector& weight) {
  work_.rounding_weight = weight;
  gradient_.rounding = kEpsilon * weight.cwiseProduct(work_.x).norm();
}

void Descent::finish(Vector& x) {
  const bool moved = report_.termination != Termination::kCancelled && has_moved();
  report_.energy_after = moved ? current_.energy : report_.energy_before;
  report_.gradient_after = moved ? gradient_.now : report_.gradient_before;
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
  stopping_.tell("assembling");
  const SparseMatrix& hessian = problem_.hessian(work_.x, choose_model(options_.strategy));
  ++report_.assemblies;
  measure_rounding(problem_.rounding_weight(hessian));
  if (gradient_is_rounding() || stopping_.is_cancelled()) return false;
  if (!work_.solver.has_pattern_of(hessian)) stopping_.tell("ordering");
  analyze(hessian);
  if (stopping_.is_cancelled()) return false;
  stopping_.tell("factorizing");
  work_.solver.factorize(hessian, progress_);
  ++report_.factorizations;
  work_.factored_model = choose_model(options_.strategy);
  work_.held.clear();
  work_.held_factor.forget();
  work_.memory.clear();
  factored_at_ = report_.iterations;
  factor_failed_ = false;
  policy_.start(gradient_.now, gradient_.reachable());
  return !stopping_.is_cancelled();
}

void Descent::analyze(const SparseMatrix& matrix) { report_.analyses += work_.analyze(matrix, problem_, progress_); }

void Descent::choose_direction() {
  stopping_.tell("iterating");
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
  return (factor_is_fresh() || !learns_from_steps()) &&
         backtrack(current_, trial_, [this](double step) { try_step(step); });
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
  policy_.observe(gradient_.now);
  ++report_.iterations;
}

void Descent::accept_trial() {
  work_.x.swap(work_.trial);
  work_.gradient.swap(work_.trial_gradient);
  current_.energy = trial_.energy;
  gradient_.now = work_.gradient.norm();
}

bool Descent::discard_factor() {
  factor_failed_ = learns_from_steps() && !factor_is_fresh();
  if (factor_failed_) return true;
  stopping_.has_no_progress();
  return false;
}

bool Descent::gradient_is_small() {
  if (gradient_.now > gradient_.wanted || !has_moved()) return gradient_is_rounding();
  return stopping_.stop(Termination::kConverged, format_sentence("The gradient is down to %.3g; %.3g was wanted.",
                                                                 gradient_.now, gradient_.wanted));
}

bool Descent::gradient_is_rounding() {
  if (gradient_.now > gradient_.rounding) return false;
  const bool untouched = !has_moved();
  return stopping_.stop(
      untouched ? Termination::kAlreadyOptimal : Termination::kConverged,
      format_sentence(
          untouched ? "Nothing to do: the gradient of the start, %.3g, does not exceed its rounding error of %.3g."
                    : "The gradient is down to %.3g, which does not exceed its rounding error of %.3g.",
          gradient_.now, gradient_.rounding));
}

bool Descent::step_is_rounding() {
  const double largest_step = work_.direction.lpNorm<Eigen::Infinity>();
  const double resolution = kEpsilon * work_.x.lpNorm<Eigen::Infinity>();
  if (!(largest_step <= resolution)) return false;
  return stopping_.stop(
      !has_moved() ? Termination::kAlreadyOptimal : Termination::kConverged,
      format_sentence("The next step would move nothing by more than %.3g, below the resolution %.3g of the unknowns.",
                      largest_step, resolution));
}

}  // namespace reflines
