#include "optimization/report_sums.h"

#include <algorithm>
#include <cmath>

namespace reflines {
namespace {

void add_work(const Report& part, Report& sum) {
  sum.evaluations += part.evaluations;
  sum.assemblies += part.assemblies;
  sum.analyses += part.analyses;
  sum.factorizations += part.factorizations;
  sum.solves += part.solves;
  sum.seconds += part.seconds;
}

// Returns the order of preference of a termination; among converged pieces one that took steps stands for all.
int rank_termination(const Report& report) {
  return report.converged() ? (report.termination == Termination::kConverged) : 2;
}

void take_termination(const Report& part, Report& sum) {
  sum.termination = part.termination;
  sum.message = part.message;
}

}  // namespace

void add_piece_report(const Report& piece, Report& sum) {
  add_work(piece, sum);
  sum.unknowns += piece.unknowns;
  sum.put_back += piece.put_back;
  sum.iterations = std::max(sum.iterations, piece.iterations);
  sum.coarse_iterations = std::max(sum.coarse_iterations, piece.coarse_iterations);
  sum.energy_before += piece.energy_before;
  sum.energy_after += piece.energy_after;
  sum.gradient_before = std::hypot(sum.gradient_before, piece.gradient_before);
  sum.gradient_after = std::hypot(sum.gradient_after, piece.gradient_after);
  if (rank_termination(piece) > rank_termination(sum)) take_termination(piece, sum);
}

void add_round_report(const Report& round, Report& sum) {
  add_work(round, sum);
  sum.iterations += round.iterations;
  sum.coarse_iterations += round.coarse_iterations;
  if (round.termination == Termination::kCancelled) take_termination(round, sum);
}

}  // namespace reflines
