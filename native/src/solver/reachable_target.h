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

// Minimizes the energy of `wanted` in a piece, then repeatedly that of its reachable part, which replaces the piece's
// rows of `reachable` (before: as `wanted`, or empty). Counts are sums over all rounds; the energy after is that of
// `wanted`, the gradient that of the first minimum. Stops after the first minimum where that was not reached; returns
// to the start where the energy of `wanted` would end above it.
Report minimize_reachable(PieceProblem& piece, const std::vector<Target>& wanted, std::vector<Target>& reachable,
                          const MinimizerOptions& options, Progress* progress);

}  // namespace reflines
