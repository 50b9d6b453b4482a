#include "optimization/descent_run.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

constexpr int kMaxTrials = 40;  // each at least halves the step, which has vanished after them

}  // namespace

DescentRun::DescentRun(Problem& problem, const MinimizerOptions& options, Progress* progress, Workspace& workspace,
                       const char* name, const RefactorPolicy& policy)
    : problem_(problem), options_(options), progress_(progress), work_(workspace), name_(name), policy_(policy) {
  report_.strategy = options.strategy;
  report_.linear_solver = workspace.solver.kind();
  report_.unknowns = problem.size();
}

Report DescentRun::run(Vector& x) {
  evaluate_start(x);
  try {
    bool goes_on = begin();
    while (goes_on && !is_cancelled() && !gradient_is_small() && !iterations_are_used_up()) {
      goes_on = choose_step();
      if (!goes_on) break;
      if (find_step())
        take_step();
      else
        goes_on = discard_matrix();
    }
  } catch (const Cancelled&) {
    is_cancelled();
  }
  finish(x);
  report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return report_;
}

double DescentRun::evaluate(const Vector& x, Vector& gradient) {
  ++report_.evaluations;
  return problem_.evaluate(x, &gradient);
}

void DescentRun::evaluate_start(const Vector& x) {
  if (x.size() != problem_.size()) {
    throw InvalidInput("The start has " + std::to_string(x.size()) + " values for " + std::to_string(problem_.size()) +
                       " unknowns; hand over one value per unknown.");
  }
  work_.resize(x.size());
  place_start(x);
  current_.energy = evaluate(work_.x, work_.gradient);
  if (!std::isfinite(current_.energy) || !std::isfinite(work_.gradient.norm()))
    throw InvalidInput("The energy at the start is not finite; remove folded or degenerate triangles from the region.");
  gradient_.now = measure_gradient();
  report_.energy_before = current_.energy;
  report_.gradient_before = gradient_.now;
  gradient_.wanted = options_.gradient_tolerance * gradient_.now;
  if (!factor_is_kept()) return;
  measure_rounding(work_.rounding_weight);
  start_policy();
}

void DescentRun::finish(Vector& x) {
  const bool moved = moved_ && report_.termination != Termination::kCancelled;
  report_.energy_after = moved ? current_.energy : report_.energy_before;
  report_.gradient_after = moved ? gradient_.now : report_.gradient_before;
  if (moved) x = work_.x;
}

HessianModel DescentRun::model() const {
  switch (options_.strategy) {
    case Strategy::kLinearized:
      return HessianModel::kLinearized;
    case Strategy::kNewton:
      return HessianModel::kNewton;
    case Strategy::kGaussNewton:
    case Strategy::kAdaptive:
      break;
  }
  return HessianModel::kGaussNewton;
}

bool DescentRun::is_outdated() const {
  if (failed_) return true;
  if (is_fresh()) return false;
  if (learns_from_steps()) return policy_.is_too_slow();
  return options_.strategy != Strategy::kLinearized ||
         assembled_at_ < 0;  // weights may have changed since a run before
}

const SparseMatrix& DescentRun::assemble() {
  tell("assembling");
  const SparseMatrix& hessian = problem_.hessian(work_.x, model());
  ++report_.assemblies;
  measure_rounding(problem_.rounding_weight(hessian));
  return hessian;
}

void DescentRun::measure_rounding(const Vector& weight) {
  work_.rounding_weight = weight;
  gradient_.rounding = kEpsilon * weight.cwiseProduct(work_.x).norm();
}

void DescentRun::start_policy() { policy_.start(gradient_.now, gradient_.reachable()); }

bool DescentRun::find_step() {
  if (!(current_.slope < 0.0)) return false;
  try_step(1.0);
  for (int count = 1; !lowers_energy_enough(current_, trial_); ++count) {
    if (count == kMaxTrials || !shortens_steps()) return false;
    try_step(shorter_step(current_, trial_));
  }
  return true;
}

void DescentRun::try_step(double step) {
  go(step);
  trial_.step = step;
  trial_.energy = evaluate(work_.trial, work_.trial_gradient);
  trial_.slope = work_.trial_gradient.dot(work_.direction);
}

void DescentRun::take_step() {
  if (learns_from_steps() && measure_step()) {
    work_.gradient = work_.trial_gradient - work_.gradient;
    work_.memory.learn(work_.direction, work_.gradient);
  }
  accept_trial();
  policy_.observe(gradient_.now);
  ++report_.iterations;
}

void DescentRun::accept_trial() {
  work_.x.swap(work_.trial);
  work_.gradient.swap(work_.trial_gradient);
  current_.energy = trial_.energy;
  gradient_.now = measure_gradient();
  moved_ = true;
}

bool DescentRun::discard_matrix() {
  failed_ = renews_failed() && !is_fresh();
  return failed_ || !has_no_progress();
}

bool DescentRun::is_cancelled() {
  if (progress_ == nullptr || !progress_->cancelled()) return false;
  return stop(Termination::kCancelled,
              format_sentence("Cancelled after %.0f steps with the " + name_ + " at %.3g; nothing was changed.",
                              steps(), gradient_.now));
}

bool DescentRun::iterations_are_used_up() {
  if (steps() < options_.max_iterations) return false;
  return stop(Termination::kIterationLimit,
              format_sentence("The limit of " + std::to_string(options_.max_iterations) +
                                  " steps was reached with the " + name_ + " at %.3g where %.3g was wanted.",
                              gradient_.now, gradient_.wanted));
}

bool DescentRun::has_no_progress() {
  return stop(Termination::kNoProgress,
              format_sentence("No step lowers the energy any further: the " + name_ + " is %.3g where %.3g was wanted.",
                              gradient_.now, gradient_.wanted));
}

bool DescentRun::stop(Termination termination, const std::string& message) {
  report_.termination = termination;
  report_.message = message;
  return true;
}

std::string DescentRun::format_sentence(const std::string& format, double first, double second) {
  char text[256];
  std::snprintf(text, sizeof text, format.c_str(), first, second);
  return text;
}

void DescentRun::tell(const char* stage) const {
  if (progress_ == nullptr) return;
  const double digits = std::log(report_.gradient_before / gradient_.now);
  const double wanted = std::log(report_.gradient_before / gradient_.reachable());
  const double fraction = wanted > 0.0 ? std::clamp(digits / wanted, 0.0, 1.0) : 0.0;
  progress_->report(std::max(fraction, progress_->fraction()), stage);
}

}  // namespace reflines
