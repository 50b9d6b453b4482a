// Finds a local minimum of a Problem by a quasi-Newton or Newton method with a line search.
#pragma once

#include <memory>

#include "optimization/linear/linear_solver.h"
#include "optimization/problem.h"
#include "optimization/row_limits.h"
#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"

namespace reflines {

struct Workspace;

// A minimizer keeps the symbolic analysis, the last factor and its work space between solves, so that the next target
// of a dragged handle costs a few back substitutions. A changed size or pattern of the Hessian is detected and analysed
// anew.
class Minimizer {
 public:
  explicit Minimizer(LinearSolverKind kind = LinearSolverKind::kCholmod);
  ~Minimizer();
  Minimizer(const Minimizer&) = delete;
  Minimizer& operator=(const Minimizer&) = delete;

  // Moves x (n, the start) to a minimum. Not converging is a value of Report::termination. x keeps its bits when the
  // solve is cancelled, already optimal, or throws (InvalidInput: a start that is not finite or of the wrong length,
  // options out of range; SolverFailure). `progress` may be null.
  Report minimize(Problem& problem, Vector& x, const MinimizerOptions& options = {}, Progress* progress = nullptr);

  // Minimizes within limits of linear functions of x, or within bounds, which x satisfies exactly (see ActiveSet); a
  // start outside is first moved into them.
  Report minimize(Problem& problem, const RowLimits& limits, Vector& x, const MinimizerOptions& options = {},
                  Progress* progress = nullptr);

  // Makes the next solve give the bits of a new minimizer's, with the symbolic analysis kept.
  void forget_factor();

 private:
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace reflines
