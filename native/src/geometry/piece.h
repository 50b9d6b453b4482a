// Splits a height field into what is solved on its own: coupled sets of triangles, each a height field with its own
// indices.
#pragma once

#include <vector>

#include "geometry/height_field.h"

namespace reflines {

// One piece of a height field, or several whose free vertices are mirror images of each other's.
struct Piece {
  HeightField field;        // vertices 0 .. #vertex - 1; `source` still names the region's triangles
  std::vector<int> vertex;  // index in the region of each vertex of the piece
  IndexVector partner;      // #vertex: the mirror image of each vertex, or -1; empty without symmetry
  int free_count = 0;       // vertices with VertexRole::kFree
};

// Splits a field; `partner` (#V of the field, or empty) are mirror images, see ShapeOptions.
std::vector<Piece> split_pieces(const HeightField& field, const IndexVector& partner = {});

}  // namespace reflines
