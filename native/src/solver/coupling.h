// The maps from unknowns to heights: those of a subdivision surface depend on its cage, those of a mesh on their own
// vertex, or on one half of it.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "geometry/piece.h"
#include "optimization/affine_map.h"
#include "reflines/types.h"

namespace reflines {

// Adapts the roles of `field` to the linear part B (#V x n) of an affine map whose unknowns start at `start` (n), and
// makes one piece of the field, since unknowns couple vertices that no triangle does. An unknown that would move a
// vertex which the field holds (of a silhouette, of a face turned away, held by the caller) is left out; vertices that
// no other moves are fixed. Returns the indices of the remaining unknowns. Throws InvalidInput where B does not fit.
std::vector<int> couple_vertices(const SparseMatrix& B, const Vector& start, HeightField& field);

// Builds the map from unknowns to the heights of a piece. Without B (0 rows) each free vertex is an unknown, or each
// pair of partners; else the unknowns are those in `free_unknowns`, and the piece is the field's only one.
AffineMap make_affine_map(const SparseMatrix& B, const Vector& start, const std::vector<int>& free_unknowns,
                          const Piece& piece);

}  // namespace reflines
