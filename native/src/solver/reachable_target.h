// Removes from targets the part that no heights attain, which would imprint the triangulation on the lines.
#pragma once

#include <vector>

#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/target.h"
#include "reflines/types.h"
#include "solver/piece_problem.h"

namespace reflines {

// The unreachable part of a smooth target is a smooth residual r that in the continuum is orthogonal to every motion:
// the integral of r D phi vanishes for every phi. The second-order stencils D are exact on quadratic heights but not
// conservative: sum A r . D phi is 0 up to noise as large as r on motions of a few triangles, which bends the lines
// from triangle to triangle however fine the mesh is. A target without r has no such effect. r is the fixed point of c
// = average(target - field solved for target - c), found by Anderson's method of depth one: on a 4-8 mesh the imprint
// itself averages to half of r, and plain iteration only halves it in each round.
//
// Beside values r is no longer orthogonal: it balances what the values lack. So what values with reachable_only lack is
// taken off them too; others are to be met.
class ReachableTarget {
 public:
  // Takes `wanted` and `piece`, which must outlive this; targets without reachable_only are not changed.
  ReachableTarget(PieceProblem& piece, const std::vector<Target>& wanted);

  // Subtracts the piece's unreachable rows from `targets` (as many as wanted) after a solve; returns false, and changes
  // nothing, where they have converged.
  bool remove_unreachable(std::vector<Target>& targets);

 private:
  PlaneVectors gather_rows(const Target& target) const;
  PlaneVectors compute_unreached();  // what the lines lack of the targets, rows of one below those of the other
  PlaneVectors average(PlaneVectors values);
  bool is_visible(const PlaneVectors& values) const;
  PlaneVectors extrapolate(const PlaneVectors& left, const PlaneVectors& change) const;

  PieceProblem& piece_;
  const std::vector<Target>& wanted_;
  Vector area_;                                  // area of the rows; 0 where they do not count
  std::vector<Mask> counts_;                     // #T for each target
  double squared_norm_ = 0.0;                    // sum of area |target|^2
  PlaneVectors unreachable_;                     // c
  PlaneVectors last_unreachable_, last_change_;  // of the previous round; empty in the first
};

// Minimizes the energy of `wanted` in a piece, then repeatedly that of its reachable part, which replaces the piece's
// rows of `reachable` (before: as `wanted`, or empty). Counts are sums over all rounds; the energy after is that of
// `wanted`, the gradient that of the first minimum. Stops after the first minimum where that was not reached; returns
// to the start where the energy of `wanted` would end above it.
Report minimize_reachable(PieceProblem& piece, const std::vector<Target>& wanted, std::vector<Target>& reachable,
                          const MinimizerOptions& options, Progress* progress);

}  // namespace reflines
