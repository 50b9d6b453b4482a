#include "native/optimization/minimizer.h"

#include <chrono>
#include <cmath>
#include <string>

#include "native/errors.h"
#include "native/optimization/descent.h"
#include "native/optimization/workspace.h"

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

Report Minimizer::minimize(Problem& problem, Vector& x, const MinimizerOptions& options, Progress* progress) {
  check(options);
  const auto start = std::chrono::steady_clock::now();
  Descent descent(problem, options, progress, *workspace_);
  Report report = descent.run(x);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace reflines
