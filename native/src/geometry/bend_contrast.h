// How far the bend of an edge stands out against the turning of the surface across it.
#pragma once

#include "geometry/crease.h"
#include "reflines/types.h"

namespace reflines {

// A triangle surface with what walks over it need.
struct BentSurface {
  const Positions& V;          // #V x 3
  const Triangles& F;          // #F x 3
  const Triangles& neighbors;  // see edge_neighbors
  Positions normals;           // see triangle_normals
  EdgeBends bend;              // see edge_bends
};

// The turning of the surface within a strip along the edge opposite corner i of t, over the larger one of the two
// strips beside it: the largest such ratio over widths from the triangles' own height up to `widest`. The turning is
// summed (without signs) along the geodesic that leaves the middle of the edge at right angles. A cylinder, a cone or a
// sphere turns alike everywhere, however coarse its polygons are: about 1; an edge of a fillet, a hem or a gap turns in
// a strip between calm neighbours. Infinite where both neighbours are flat; negative where the surface ends too soon on
// both sides to tell.
double bend_contrast(const BentSurface& surface, int t, int i, double widest);

// The corner, in the triangle across it, that the edge opposite corner i of t is opposite of.
int facing_corner(const BentSurface& surface, int t, int i);

}  // namespace reflines
