// Finds the edges at which a mesh is no fair surface: gaps, folds, hems.
#pragma once

#include "reflines/crease_options.h"
#include "reflines/types.h"

namespace reflines {

// #T x 3, unit; 0 for triangles without area.
Positions triangle_normals(const Positions& V, const Triangles& F);

// #T x 3: the angle between the normals (#T x 3) on both sides of the edge opposite that corner, radians; 0 on borders.
using EdgeBends = Eigen::Array<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
EdgeBends edge_bends(const Positions& normals, const Triangles& neighbors);

// #T x 3, true where the edge opposite that corner is a crease: marked, or found. Found is an edge whose bend jumps
// against the surface across it (see bend_contrast), at the width of one triangle or of any strip up to 8 % of the
// region, and that bends by more than the angle, or belongs to a connected chain of edges that jump, bend by more than
// a quarter of the angle each and reach over 8 % of the region. Where the surface ends too soon to tell, an edge
// sharper than the angle is one. Round shapes bend alike all over and have none, however coarse they are. A few
// vertices out of place bend edges as sharply as a crease, but not in a long chain: they are to be faired, the gap to
// the windscreen is not. Measured on a car's bonnet selected across that gap, 140 rad / m against 0.5 on the panel:
// solved as one surface, vertices move by 92 mm; with the gap held, by 0.7 mm.
using EdgeMask = Eigen::Array<bool, Eigen::Dynamic, 3, Eigen::RowMajor>;
EdgeMask crease_edges(const Positions& V, const Triangles& F, const Triangles& neighbors, const CreaseOptions& options);

// #T x 3, true where the edge opposite that corner is one of the marked ones.
EdgeMask marked_edges(const Triangles& F, const CreaseOptions& options);

}  // namespace reflines
