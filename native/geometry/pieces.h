// A height field taken apart into its pieces, each a height field of its own with its own numbering.
#pragma once

#include <vector>

#include "native/geometry/height_field.h"

namespace reflines {

struct Piece {
  HeightField field;        // one piece; vertices 0 .. #vertex - 1; `source` still names the region's triangles
  std::vector<int> vertex;  // the region's vertex for each of the piece's
  int free_count = 0;       // vertices with VertexRole::kFree
};

std::vector<Piece> split_pieces(const HeightField& field);

}  // namespace reflines
