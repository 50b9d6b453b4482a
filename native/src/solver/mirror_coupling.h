// The coupling of a mesh's vertices with their mirror images, which keep equal moves along the view: one unknown moves
// both. `partner` (#V, or empty for none) is that of ShapeOptions.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "geometry/piece.h"
#include "reflines/move_limit.h"
#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput unless `partner` is empty, or has for each of the vertices -1 or a vertex whose partner it is.
void check_partners(const IndexVector& partner, Eigen::Index vertex_count);

// Gives two partners the firmer one of their conditions at the border; one that is held holds the other.
void hold_partners(const IndexVector& partner, Boundary& boundary);

// Fixes free vertices whose partners stay: a mesh that is symmetric but for rounding may have its silhouettes and
// creases on one side only, and the cut of its quads clamps other vertices on either side.
void hold_partners(const IndexVector& partner, HeightField& field);

// Returns the moves that are within the limits of both partners.
MoveLimit intersect_limits(const MoveLimit& limit, const IndexVector& partner);

// Chooses the vertex whose height is the unknown that moves a vertex (#V of the piece): itself or its partner, of every
// pair the one on the same side of the mirror plane, so that the unknowns of neighbours lie near each other; -1 for
// vertices that stay.
std::vector<int> choose_leaders(const Piece& piece);

}  // namespace reflines
