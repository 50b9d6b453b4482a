// The vertices of a mesh that are in faces, numbered anew. The others may be anywhere, and be no number either: they
// are part of no size, no symmetry and no system of equations.
#pragma once

#include <vector>

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

struct UsedVertices {
  std::vector<int> index;  // ascending, in the given mesh
  Triangles F;             // #F x 3, into `index`
  IndexVector number;      // #V of the given mesh, into `index`, or -1
};

// Finds the vertices of F (#F x 3), which must have passed check_indices against `vertex_count`.
UsedVertices find_used_vertices(const Triangles& F, int vertex_count);

// Returns the mirror images of the used vertices, from those of all; -1 where the image is in no face.
IndexVector renumber_partners(const IndexVector& partner, const UsedVertices& used);

// Returns the surroundings of the used vertices, from those of all `vertex_count`. Triangles that name one in no face
// are left out.
Surroundings renumber_surroundings(const Surroundings& around, const UsedVertices& used, int vertex_count);

}  // namespace reflines
