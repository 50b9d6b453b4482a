// Targets without what no heights can reach, so that a wish that cannot be met does not print the mesh into the field.
#pragma once

#include <vector>

#include "reflines/minimizer_options.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/target.h"
#include "reflines/types.h"
#include "solver/piece_problem.h"

namespace reflines {

// What a solve cannot reach of a smooth wish is a smooth residual r, and in the continuum no motion sees it: the
// integral of r D phi vanishes for every phi. The second-order stencils D are exact on quadratic heights but not
// conservative: sum A r . D phi is 0 up to noise as large as r on motions of a few triangles, which bends the lines
// from triangle to triangle however fine the mesh is. A target without r leaves nothing to be seen. r is the fixed
// point of "solve for the wish less c; c = local average of what is left of the wish", found by Anderson's method of
// depth one: on a 4-8 mesh the print itself averages to half of r, and plain iteration takes half of it away at a time.
// Measured with a density of 1.5 on a clean panel, clamped, 20 | 40 | 80 cells a side: kinks of the lines between
// neighbours (degrees, rms), 18.9 | 18.6 | 18.5 on a 4-8 mesh become 0.4 | 0.2 | 0.1, 11.0 | 10.4 | 10.2 with diagonals
// by chance 0.3 | 0.2 | 0.1, 9.8 | 9.6 | 9.6 on a Delaunay mesh 0.3 | 0.2 | 0.2, 0.3 | 0.2 | 0.1 on a regular one stay.
class ReachableTarget {
 public:
  // `wanted` and `piece` must outlive this; targets that do not ask for it are left as they are.
  ReachableTarget(PieceProblem& piece, const std::vector<Target>& wanted);

  // After a solve: takes the piece's unreachable rows out of `targets` (as many as wanted); false, and no change, where
  // they are as before up to a share of the wish that nobody sees.
  bool improve(std::vector<Target>& targets);

 private:
  PlaneVectors rows_of(const Target& target) const;
  PlaneVectors left_over();                    // of the wish: the rows of one target under those of the other
  PlaneVectors averaged(PlaneVectors values);  // of such rows
  bool is_seen(const PlaneVectors& values) const;
  PlaneVectors next(const PlaneVectors& left, const PlaneVectors& change) const;

  PieceProblem& piece_;
  const std::vector<Target>& wanted_;
  Vector area_;                                  // of the rows below; 0 where they do not count
  std::vector<Mask> counts_;                     // #T, a target each
  double wish_ = 0.0;                            // root mean square times area
  PlaneVectors unreachable_;                     // c
  PlaneVectors last_unreachable_, last_change_;  // of the round before; empty in the first
};

// Minimizes the energy of `wanted` in a piece, then some times that of what can be reached of it, which comes
// to stand in the piece's rows of `reachable` (before: as `wanted`). Counts are sums over all rounds; the energy after
// is that of the wish, the gradient that of the first minimum. Stops after the first minimum where that was not
// reached.
Report minimize_reachable(PieceProblem& piece, const std::vector<Target>& wanted, std::vector<Target>& reachable,
                          const MinimizerOptions& options, Progress* progress);

}  // namespace reflines
