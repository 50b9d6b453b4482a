// Unknowns and subdivision matrices that keep a symmetric cage symmetric.
#pragma once

#include "reflines/mirror_pairs.h"
#include "reflines/types.h"

namespace reflines {

// B, #V x n, of z = B x + c for heights of a cage: one unknown a pair of partners and one for each other vertex, in the
// order of their first vertices; none where the vertex or its partner is held. `partner` may be empty: no symmetry.
// Heights of partners rise alike, which keeps a cage symmetric where the view direction lies in the plane.
SparseMatrix cage_unknowns(const Mask& held, const IndexVector& partner);

// #rows of S: the row that S turns into when partners are exchanged, itself for rows of the plane, -1 where there is
// none: refined vertices in each other's image. Found from the weights alone.
IndexVector refined_partners(const SparseMatrix& S, const IndexVector& partner);

// S with the weights of partners alike bit for bit: OpenSubdiv adds them up in an order of its own, and they differ by
// 3e-16.
SparseMatrix symmetrized(const SparseMatrix& S, const IndexVector& partner, const IndexVector& refined_partner);

// S V for such an S, added up in such an order that partners lie in each other's image bit for bit where those of the
// cage do.
Positions symmetric_positions(const SparseMatrix& S, const IndexVector& partner, const IndexVector& refined_partner,
                              const Positions& V);

}  // namespace reflines
