// Unknowns and subdivision matrices that preserve the symmetry of a cage.
#pragma once

#include "reflines/mirror_pairs.h"
#include "reflines/types.h"

namespace reflines {

// Builds B (#V x n) of z = B x + c for heights of a cage: one unknown for each pair of partners and for each other
// vertex, in the order of their first vertices; none where the vertex or its partner is held. `partner` may be empty:
// no symmetry. Partners have equal moves, which preserves the symmetry where the view direction lies in the plane.
SparseMatrix build_cage_unknowns(const Mask& held, const IndexVector& partner);

// Returns for each row of S (#rows) the row that it becomes when partners are exchanged, itself for rows of the plane,
// -1 where there is none: the refined vertices that are mirror images. Found from the weights alone.
IndexVector find_refined_partners(const SparseMatrix& S, const IndexVector& partner);

// Returns S with weights of partners that are equal bit for bit: OpenSubdiv's sums depend on the order, and differ by
// 3e-16.
SparseMatrix symmetrize(const SparseMatrix& S, const IndexVector& partner, const IndexVector& refined_partner);

// Returns S V for such an S, summed in an order that makes partners mirror images bit for bit where those of the cage
// are.
Positions multiply_symmetric(const SparseMatrix& S, const IndexVector& partner, const IndexVector& refined_partner,
                             const Positions& V);

}  // namespace reflines
