// The open border of a region: where its surface ends, with the directions in which it would run on.
#pragma once

#include <vector>

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

struct BorderEdge {
  int first, second;  // vertices, in the order of the region's triangle
  int triangle;
};

struct OpenBorder {
  std::vector<BorderEdge> edges;  // the open ones
  Mask vertices;                  // #V: those of open edges
  Mask elsewhere;                 // #V: those of border edges that are not open
  Positions normal;               // #V x 3 at these vertices: of the region
  Positions outward;              // #V x 3 likewise: in its tangent plane, across the border
  double edge = 0;                // mean length of the open edges
};

// Finds the open border of the region V (#V x 3), F (#F x 3): the edges with one triangle, of which none of `around`
// that has them, too, faces the same way within 60 degrees.
OpenBorder find_open_border(const Positions& V, const Triangles& F, const Surroundings& around);

}  // namespace reflines
