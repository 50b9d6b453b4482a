// The cells of a square grid in the image plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "reflines/types.h"

namespace reflines {

using GridCell = std::pair<int, int>;
using GridCells = std::map<GridCell, std::vector<int>>;  // the numbers of what lies in each

// Returns the cell of `point` in a grid of cells of this size. Cells beyond a milliard, where a broken mesh may have a
// vertex, and those of no numbers are the outermost ones: no int overflows, also one cell further.
inline GridCell find_grid_cell(const Vector2& point, double size) {
  constexpr double kFarthest = 1e9;
  const auto clamp = [=](double cell) {
    return static_cast<int>(cell > -kFarthest ? std::min(cell, kFarthest) : -kFarthest);
  };
  return {clamp(std::floor(point.x() / size)), clamp(std::floor(point.y() / size))};
}

// Calls take(number) for what lies in all cells up to so many away.
template <typename Take>
void for_each_near(const GridCells& cells, const GridCell& cell, int rings, const Take& take) {
  for (int i = -rings; i <= rings; ++i) {
    for (int j = -rings; j <= rings; ++j) {
      const auto found = cells.find({cell.first + i, cell.second + j});
      if (found != cells.end()) std::for_each(found->second.begin(), found->second.end(), take);
    }
  }
}

// Leaves about `most` numbers of more, picked pseudo-randomly (Fibonacci hashing, with the high bits first): of every
// 2^n one, so that what is picked hangs on the number, not on the others.
inline void thin_out(std::vector<int>& numbers, std::size_t most) {
  std::uint32_t stride = 1;
  while (numbers.size() > stride * most) stride *= 2;
  std::erase_if(numbers, [&](int k) { return ((static_cast<std::uint32_t>(k) * 2654435769U) >> 16) % stride != 0; });
}

}  // namespace reflines
