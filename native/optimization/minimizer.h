// Finds a local minimum of a Problem, from a start close enough to it.
#pragma once

#include <memory>

#include "native/optimization/linear_solver.h"
#include "native/optimization/options.h"
#include "native/optimization/problem.h"
#include "native/optimization/progress.h"
#include "native/optimization/report.h"

namespace reflines {

struct Workspace;

// Keeps the symbolic analysis, the last factor and its work space between solves, so that the next target of a dragged
// handle costs a few back substitutions. A changed size or pattern of the Hessian is noticed and analysed anew.
class Minimizer {
 public:
  explicit Minimizer(LinearSolverKind kind = LinearSolverKind::kCholmod);
  ~Minimizer();
  Minimizer(const Minimizer&) = delete;
  Minimizer& operator=(const Minimizer&) = delete;

  // Moves x (n, the start) to a minimum. Not converging is a value of Report::termination. x keeps its bits when the
  // solve is cancelled, already optimal, or throws (InvalidInput: a start that is not finite or of the wrong length,
  // options out of range;
  // SolverFailure). `progress` may be null.
  Report minimize(Problem& problem, Vector& x, const MinimizerOptions& options = {}, Progress* progress = nullptr);

 private:
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace reflines
