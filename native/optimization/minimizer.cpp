#include "native/optimization/minimizer.h"

#include <chrono>

#include "native/optimization/descent.h"
#include "native/optimization/workspace.h"

namespace reflines {

Minimizer::Minimizer(LinearSolverKind kind) : workspace_(std::make_unique<Workspace>(kind)) {}

Minimizer::~Minimizer() = default;

Report Minimizer::minimize(Problem& problem, Vector& x, const MinimizerOptions& options, Progress* progress) {
  const auto start = std::chrono::steady_clock::now();
  Descent descent(problem, options, progress, *workspace_);
  Report report = descent.run(x);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace reflines
