// The cells of a square grid in the image plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "reflines/types.h"

namespace reflines {

// Returns the cell of `point` in a grid of cells of this size. Cells beyond a milliard, where a broken mesh may have a
// vertex, and those of no numbers are the outermost ones: no int overflows, also one cell further.
inline std::pair<int, int> find_grid_cell(const Vector2& point, double size) {
  constexpr double kFarthest = 1e9;
  const auto clamp = [=](double cell) {
    return static_cast<int>(cell > -kFarthest ? std::min(cell, kFarthest) : -kFarthest);
  };
  return {clamp(std::floor(point.x() / size)), clamp(std::floor(point.y() / size))};
}

}  // namespace reflines
