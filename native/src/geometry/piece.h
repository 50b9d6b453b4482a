// Splits a height field into its pieces: coupled sets of triangles, each a height field with its own indices.
#pragma once

#include <vector>

#include "geometry/height_field.h"

namespace reflines {

struct Piece {
  HeightField field;        // one piece; vertices 0 .. #vertex - 1; `source` still names the region's triangles
  std::vector<int> vertex;  // index in the region of each vertex of the piece
  int free_count = 0;       // vertices with VertexRole::kFree
};

std::vector<Piece> split_pieces(const HeightField& field);

}  // namespace reflines
