// Heights that are no unknowns of their own but follow fewer ones: those of a subdivision surface follow its cage,
// those of a symmetric one half of it.
#pragma once

#include <vector>

#include "native/geometry/height_field.h"
#include "native/geometry/pieces.h"
#include "native/optimization/unknowns.h"
#include "native/types.h"

namespace reflines {

struct Motion {
  SparseMatrix B;  // #V x n: by how much unknown j lifts vertex v; empty: every free vertex is its own unknown
  Vector x;        // n: heights of the unknowns at the start

  bool empty() const { return B.rows() == 0; }
};

// Fits the roles of `field` to the motion, and makes one piece of it: unknowns couple what triangles do not. An unknown
// that would move a vertex which the field holds (of a silhouette, of a face turned away, held by the caller) is left
// out; vertices that no other moves are fixed. Returns the numbers of the unknowns that stay; throws InvalidInput where
// B does not fit.
std::vector<int> couple(const Motion& motion, HeightField& field);

// The unknowns of the field's only piece: those of `motion` that `kept` names, or its free vertices without a motion.
Unknowns unknowns_of(const Motion& motion, const std::vector<int>& kept, const Piece& piece);

}  // namespace reflines
