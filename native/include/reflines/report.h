// The report of a solve: its termination, the counts of what it did, and the change of the energy.
#pragma once

#include <string>

#include "reflines/linear_solver_kind.h"
#include "reflines/minimizer_options.h"

namespace reflines {

enum class Termination {
  kConverged,       // the gradient is down by the tolerance, or is as small as rounding lets it be
  kAlreadyOptimal,  // the gradient was that small at the start, or nothing reachable is nearer; x was not touched
  kNoProgress,      // no step along the last direction lowers the energy
  kIterationLimit,  // max_iterations steps were taken
  kCancelled,       // Progress::cancel was called; x was not touched
};
const char* to_string(Termination termination);  // "converged", "already_optimal", "no_progress", ...

struct Report {
  Termination termination = Termination::kIterationLimit;
  std::string message;  // one sentence for the user, with the two numbers compared
  Strategy strategy = Strategy::kAdaptive;
  LinearSolverKind linear_solver = LinearSolverKind::kCholmod;

  // The counts of the work done.
  int unknowns = 0;
  int iterations = 0;         // accepted steps
  int coarse_iterations = 0;  // accepted steps of the coarse correction, before those
  int evaluations = 0;        // of the energy, with or without gradient
  int assemblies = 0;         // of a Hessian
  int analyses = 0;           // symbolic
  int factorizations = 0;     // numeric
  int solves = 0;             // with a factor

  double energy_before = 0.0;
  double energy_after = 0.0;
  double gradient_before = 0.0;  // Euclidean norms
  double gradient_after = 0.0;
  double seconds = 0.0;

  int put_back = 0;  // unknowns outside the bounds at the start, moved into them before anything else

  // The results in terms of the surface, filled in by the owner of the geometry: the minimizer does not know it.
  int limited = 0;                // vertices that touch the limit; see ShapeOptimizer::at_limit
  double limited_fraction = 0.0;  // those as a fraction of the free vertices
  double largest_move = 0.0;      // along the view direction, scene units
  double residual_rms =
      0.0;  // root mean square of |grad theta - target| over the triangles that can change, radians / length

  bool converged() const {
    return termination == Termination::kConverged || termination == Termination::kAlreadyOptimal;
  }
};

}  // namespace reflines
