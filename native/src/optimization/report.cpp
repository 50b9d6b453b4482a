#include "reflines/report.h"

#include <algorithm>
#include <cmath>

namespace reflines {

const char* to_string(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return "converged";
    case Termination::kAlreadyOptimal:
      return "already_optimal";
    case Termination::kNoProgress:
      return "no_progress";
    case Termination::kIterationLimit:
      return "iteration_limit";
    case Termination::kCancelled:
      return "cancelled";
  }
  return "";
}

void add_piece_report(const Report& piece, Report& sum) {
  sum.unknowns += piece.unknowns;
  sum.put_back += piece.put_back;
  sum.iterations = std::max(sum.iterations, piece.iterations);
  sum.coarse_iterations = std::max(sum.coarse_iterations, piece.coarse_iterations);
  sum.evaluations += piece.evaluations;
  sum.assemblies += piece.assemblies;
  sum.analyses += piece.analyses;
  sum.factorizations += piece.factorizations;
  sum.solves += piece.solves;
  sum.energy_before += piece.energy_before;
  sum.energy_after += piece.energy_after;
  sum.gradient_before = std::hypot(sum.gradient_before, piece.gradient_before);
  sum.gradient_after = std::hypot(sum.gradient_after, piece.gradient_after);
  sum.seconds += piece.seconds;
  // The least happy piece speaks for all; among the happy ones, one that did something.
  const auto rank = [](const Report& r) { return r.converged() ? (r.termination == Termination::kConverged) : 2; };
  if (rank(piece) > rank(sum)) {
    sum.termination = piece.termination;
    sum.message = piece.message;
  }
}

}  // namespace reflines
