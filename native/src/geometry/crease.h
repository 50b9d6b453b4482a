// Finds the creases of a mesh: edges of gaps, folds and hems, across which the surface is not smooth.
#pragma once

#include "reflines/crease_options.h"
#include "reflines/types.h"

namespace reflines {

// Returns unit normals (#T x 3); 0 for triangles without area.
Positions triangle_normals(const Positions& V, const Triangles& F);

// The angles between the normals (#T x 3) on both sides of the edge opposite each corner (#T x 3), radians; 0 on
// borders.
using EdgeBends = Eigen::Array<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
EdgeBends edge_bends(const Positions& normals, const Triangles& neighbors);

// Marks the creases, #T x 3 by the corner opposite the edge: marked edges, and found ones. An edge is found where its
// bend stands out against the surface beside it (see bend_contrast), at the width of one triangle or of any strip up to
// 8 % of the region, and where it bends by more than the angle, or belongs to a connected chain of such edges that bend
// by more than a quarter of the angle each and extend over 8 % of the region. Where the surface ends too soon to
// decide, an edge sharper than the angle is a crease. Round shapes have none, however coarse; nor do a few displaced
// vertices, which are to be faired, whereas the gap to the windscreen is not.
using EdgeMask = Eigen::Array<bool, Eigen::Dynamic, 3, Eigen::RowMajor>;
EdgeMask crease_edges(const Positions& V, const Triangles& F, const Triangles& neighbors, const CreaseOptions& options);

// Marks the edges of options.marked, #T x 3 by the corner opposite the edge.
EdgeMask marked_edges(const Triangles& F, const CreaseOptions& options);

}  // namespace reflines
