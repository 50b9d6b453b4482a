// The fuzzer's bytes as a mesh.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "reflines/types.h"
#include "tests/fuzz/bytes.h"

namespace reflines::fuzz {

// A grid with holes, doubled and turned faces, and moved vertices: most of it is a surface.
inline void read_mesh(Bytes& bytes, Positions& V, Triangles& F) {
  const int columns = bytes.between(1, 9), rows = bytes.between(1, 9);
  V.resize((columns + 1) * (rows + 1), 3);
  for (int v = 0; v < V.rows(); ++v) {
    const double x = double(v % (columns + 1)) / columns, y = double(v / (columns + 1)) / rows;
    V.row(v) << x, y, -0.2 * x * x - 0.1 * y * y;
  }
  std::vector<int> corners;
  for (int cell = 0; cell < columns * rows; ++cell) {
    const int a = cell / columns * (columns + 1) + cell % columns, b = a + 1, c = a + columns + 2, d = a + columns + 1;
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  for (int change = bytes.below(12); change > 0 && !bytes.empty(); --change) {
    const int kind = bytes.below(4), place = bytes.below(255) * static_cast<int>(corners.size()) / 255;
    if (kind == 0) V(bytes.below(255) * V.rows() / 255, bytes.below(3)) += 0.2 * bytes.number();
    if (kind == 1) corners[place] = bytes.between(-1, static_cast<int>(std::min<Eigen::Index>(V.rows(), 250)));
    if (kind == 2) std::swap(corners[place], corners[place / 3 * 3]);
    if (kind == 3) corners.erase(corners.begin() + place / 3 * 3, corners.begin() + place / 3 * 3 + 3);
    if (corners.empty()) break;
  }
  F = Eigen::Map<const Triangles>(corners.data(), static_cast<int>(corners.size()) / 3, 3);
}

// Also where both have the same numbers that are none: vertices in no face keep them.
inline bool are_same(const Positions& a, const Positions& b) {
  return a.rows() == b.rows() && ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
}

// A few held vertices, or an empty mask.
inline Mask read_held(Bytes& bytes, Eigen::Index vertices) {
  if (!bytes.flag()) return {};
  Mask held = Mask::Constant(vertices, false);
  for (int k = bytes.below(8); k > 0; --k) held(bytes.below(255) * vertices / 255) = true;
  return held;
}

}  // namespace reflines::fuzz
