// One solve of a panel for the targets of a tool, with the rules that hold for every tool.
#pragma once

#include <memory>
#include <vector>

#include "reflines/line_score.h"
#include "reflines/move_limit.h"
#include "reflines/progress.h"
#include "reflines/report.h"
#include "reflines/shape_optimizer.h"
#include "reflines/surroundings.h"
#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

// Unknowns up to which a shape within a limit is solved for; above, moves are scaled to it, and those that a press
// finds saturate. A cage whose limit a half of the unknowns touch takes 30 s.
inline constexpr int kMostBounded = 100000, kMostBoundedCage = 8000;

struct SolvePanelOptions {
  double length = 0.0;  // of the scores, above 0: detail that is finer counts as a deviation
  double limit = 0.0;   // no vertex moves further along the view, in units of V; may be infinite
  // Fractions of the limit for each vertex of the optimizer (#V): the lowest moves -1 to 0, the highest 0 to 1. Empty:
  // -1 and 1 everywhere.
  MoveLimit limit_range;
  Surroundings around;   // or none: faces that the region's rim is bent against
  int most_bounded = 0;  // unknowns up to which moves are bounded; 0: kMostBounded, of a cage kMostBoundedCage
};

// Tells what a solve did. Residuals are those of the first target.
struct SolvePanelReport {
  Report solve;                         // of the last solve, with this surface's largest move
  int limited = 0;                      // vertices that the limit holds back
  LineScore score_before, score_after;  // of the heights that the optimizer was built with, and of the result
  double residual_before = 0.0, residual_after = 0.0;  // root mean square by area and weight, radians / length
  Vector residual;                                     // #F
  bool falls_short = false;  // less than a fifth was reached of a target that is a visible change
  int held_faces = 0;        // faces that would have turned by more than 45 degrees and were held instead
  int turned_faces = 0;      // faces that turned so far all the same
  double rim_bend = 0.0;     // by which the edges to the faces around bend more than before, at most, radians
};

// Solves for the targets from the optimizer's present heights:
//  1. freely, and where a vertex moved beyond the limit again within it, beginning with all moves scaled to it;
//  2. where few faces turn by more than 45 degrees (see solver/turned_faces.h), for a move along the view slides a
//     steep face over its neighbour, again with their vertices held, as long as fewer turn so; many turn because the
//     wanted lines do that.
// The optimizer has the heights of the result. A cancelled or failed solve leaves them as they were. Throws
// InvalidInput, SolverFailure.
SolvePanelReport solve_panel(ShapeOptimizer& optimizer, const std::vector<Target>& targets,
                             const SolvePanelOptions& options, Progress* progress = nullptr);

// Returns the root mean square of the residual over the triangles that can change, by area and the target's weight.
double measure_residual(const ShapeOptimizer& optimizer, const Target& target);

}  // namespace reflines
