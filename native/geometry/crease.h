// Which edges are features of a mesh (gaps, folds, hems) and no part of a fair panel.
#pragma once

#include "native/types.h"

namespace reflines {

// Edges that bend by more than this (30 degrees) are always creases.
constexpr double kCreaseAngle = 0.5235987755982988;

// #T x 3, unit; 0 for triangles without area.
Positions triangle_normals(const Positions& V, const Triangles& F);

// #T x 3: the angle between the normals (#T x 3) on both sides of the edge opposite that corner, radians; 0 on borders.
using EdgeBends = Eigen::Array<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
EdgeBends edge_bends(const Positions& normals, const Triangles& neighbors);

// #T x 3, true where the edge opposite that corner is a crease: it bends by more than `angle`; or it belongs to a
// connected chain of edges that bend by more than a quarter of `angle` and 25 times the median edge, and reach over 8 %
// of the region. A few vertices out of place bend edges as sharply, but not in a long chain: they are to be faired, the
// gap to the windscreen is not. Measured on a car's bonnet selected across that gap, 140 rad / m against 0.5 on the
// panel: solved as one surface, vertices move by 92 mm; with the gap held, by 0.7 mm.
using EdgeMask = Eigen::Array<bool, Eigen::Dynamic, 3, Eigen::RowMajor>;
EdgeMask crease_edges(const Positions& V, const Triangles& F, const Triangles& neighbors, double angle);

}  // namespace reflines
