// The contrast between the bend of an edge and the turning of the surface beside it.
#pragma once

#include "geometry/crease.h"
#include "reflines/types.h"

namespace reflines {

// A triangle surface with the data of geodesic walks on it.
struct BentSurface {
  const Positions& V;          // #V x 3
  const Triangles& F;          // #F x 3
  const Triangles& neighbors;  // see edge_neighbors
  Positions normals;           // see triangle_normals
  EdgeBends bend;              // see edge_bends
};

// Returns the turning of the surface within a strip along the edge opposite corner i of t, divided by the larger
// turning in the two strips beside it: the largest such ratio over strip widths from the triangles' own height up to
// `widest`. The turning is summed (unsigned) along the geodesic perpendicular to the edge through its midpoint.
// Cylinders, cones and spheres turn uniformly, however coarse their polygons: about 1; the turning of a fillet, a hem
// or a gap is concentrated. Infinite where both neighbours are flat; negative where the surface ends too soon on both
// sides to decide.
double bend_contrast(const BentSurface& surface, int t, int i, double widest);

// Returns the corner of the neighbouring triangle that is opposite the edge shared with corner i of t.
int find_facing_corner(const Triangles& F, const Triangles& neighbors, int t, int i);

}  // namespace reflines
