// Checks of the input and the outcome of a solve.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput unless there is no quadrature weight, or one for each of the triangles, finite and not negative.
void check_quadrature_weight(const Vector& weight, Eigen::Index triangles);

// Throws SolverFailure where a solve moved a vertex of V (#V x 3) by more than ten diagonals of all of them along the
// view, or to where float32, in which Blender keeps positions, has no number. Not a number counts as too far.
void check_reach(const Positions& V, double largest_move);

}  // namespace reflines
