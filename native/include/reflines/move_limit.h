// The limit of the moves of vertices along the view, relative to the heights that the optimizer was built with.
#pragma once

#include "reflines/types.h"

namespace reflines {

// The range of each vertex's move; ShapeOptimizer::positions respects it exactly, to the last bit, and so does the
// surface of CageOptimizer::cage_positions.
struct MoveLimit {
  Vector lowest, highest;  // #V each, lowest <= 0 <= highest, infinite where there is none; empty: no limit

  bool exists() const { return highest.size() > 0; }

  static MoveLimit none() { return {}; }
  static MoveLimit within(double length, int vertex_count) {  // either way
    return {Vector::Constant(vertex_count, -length), Vector::Constant(vertex_count, length)};
  }
};

}  // namespace reflines
