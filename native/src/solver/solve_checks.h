// Checks of the input and the outcome of a solve.
#pragma once

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput unless the quadrature weight is empty or has one finite value of at least 0 for each of the
// triangles.
void check_quadrature_weight(const Vector& weight, Eigen::Index triangles);

// Throws InvalidInput unless the list of faces is empty or has one for each of the triangles.
void check_face_of_triangle(const IndexVector& face, Eigen::Index triangles);

// Throws InvalidInput where the triangles around a region of `vertices` name one that there is not, or a coordinate is
// not finite.
void check_surroundings(const Surroundings& around, Eigen::Index vertices);

// Throws SolverFailure where a solve moved a vertex of the region V (#V x 3), F (#F x 3) along the view by more than
// ten of its diagonals, or beyond the range of float32, in which Blender stores positions. NaN counts as too far.
// Vertices in no face may be anywhere.
void check_reach(const Positions& V, const Triangles& F, double largest_move);

}  // namespace reflines
