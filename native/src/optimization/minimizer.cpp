#include "optimization/minimizer.h"

#include <cmath>
#include <string>

#include "optimization/descent.h"
#include "optimization/limited_descent.h"
#include "optimization/workspace.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

void check(const MinimizerOptions& options) {
  if (!(options.gradient_tolerance >= 0) || !std::isfinite(options.gradient_tolerance)) {
    throw InvalidInput("The gradient tolerance is " + std::to_string(options.gradient_tolerance) +
                       "; give the share of the gradient that may be left, 0 or more.");
  }
  if (options.max_iterations < 0) {
    throw InvalidInput("The limit of steps is " + std::to_string(options.max_iterations) + "; give 0 or more.");
  }
}

}  // namespace

Minimizer::Minimizer(LinearSolverKind kind) : workspace_(std::make_unique<Workspace>(kind)) {}

Minimizer::~Minimizer() = default;

void Minimizer::forget_factor() { workspace_->forget_factor(); }

Report Minimizer::minimize(Problem& problem, Vector& x, const MinimizerOptions& options, Progress* progress) {
  check(options);
  return descend(problem, x, options, progress, *workspace_);
}

Report Minimizer::minimize(Problem& problem, const RowLimits& limits, Vector& x, const MinimizerOptions& options,
                           Progress* progress) {
  check(options);
  return descend_within(limits, problem, x, options, progress, *workspace_);
}

}  // namespace reflines
