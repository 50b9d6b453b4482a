// The parts of a region that no edge joins, each with what lies beside it.
#pragma once

#include <vector>

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

struct RegionPart {
  std::vector<int> vertices;         // of the mesh
  Triangles F;                       // names these by their numbers
  std::vector<int> around_vertices;  // vertices of other triangles that touch the part
  Triangles F_around;                // see Surroundings
  std::vector<int> beside;           // triangles of the mesh that are not the part's, near its box

  Positions positions(const Positions& V) const { return V(vertices, Eigen::all); }
  Surroundings around(const Positions& V) const { return {V(around_vertices, Eigen::all), F_around}; }
};

struct RegionParts {
  std::vector<RegionPart> list;
  IndexVector part;  // #F: of each triangle, -1 beside them
};

// Splits the region (#F) of V (#V x 3), F (#F x 3); triangles are near that have a vertex within `near` diagonals of
// the part's box. Of more than 64 parts the largest ones are taken, the others count as beside the region.
RegionParts split_region(const Positions& V, const Triangles& F, const Mask& region, double near);

}  // namespace reflines
