// Splits a height field into its pieces: coupled sets of triangles, each a height field with numbers of its own.
#pragma once

#include <vector>

#include "geometry/height_field.h"

namespace reflines {

struct Piece {
  HeightField field;        // one piece; vertices 0 .. #vertex - 1; `source` still names the region's triangles
  std::vector<int> vertex;  // the region's vertex for each of the piece's
  int free_count = 0;       // vertices with VertexRole::kFree
};

std::vector<Piece> split_pieces(const HeightField& field);

}  // namespace reflines
