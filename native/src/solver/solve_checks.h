// Checks of the input and the outcome of a solve.
#pragma once

#include <Eigen/Geometry>

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput unless the quadrature weight is empty or has one finite value of at least 0 for each of the
// triangles.
void check_quadrature_weight(const Vector& weight, Eigen::Index triangles);

// Throws InvalidInput unless the list of faces is empty or has one for each of the triangles.
void check_face_of_triangle(const IndexVector& face, Eigen::Index triangles);

// Throws InvalidInput where a marked crease (#E x 2) names a vertex that there is not.
void check_marked_creases(const Edges& creases, Eigen::Index vertices);

// Throws InvalidInput where the weight of the pull to the start is not a finite number; negative ones are automatic.
void check_proximity(double proximity);

// Throws InvalidInput where the triangles around a region of `vertices` name one that there is not, or a coordinate is
// not finite.
void check_surroundings(const Surroundings& around, Eigen::Index vertices);

// Throws SolverFailure where a solve moved a vertex of a region in this box along the view by more than ten of its
// diagonals, or beyond the range of float32, in which Blender stores positions. NaN counts as too far.
void check_move_size(const Eigen::AlignedBox3d& region, double largest_move);

}  // namespace reflines
