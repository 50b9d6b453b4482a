// Small cages with the features subdivision has rules for.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "reflines/cage.h"

namespace reflines {

// A cage and where its vertices are.
struct PlacedCage {
  Cage cage;
  Positions V;
};

// Any polygons.
inline Cage polygons(int vertices, const std::vector<std::vector<int>>& faces) {
  Cage cage;
  cage.vertices = vertices;
  cage.face_offsets = IndexVector::Zero(static_cast<int>(faces.size()) + 1);
  std::vector<int> corners;
  for (size_t f = 0; f < faces.size(); ++f) {
    corners.insert(corners.end(), faces[f].begin(), faces[f].end());
    cage.face_offsets[static_cast<int>(f) + 1] = static_cast<int>(corners.size());
  }
  cage.face_vertices = Eigen::Map<IndexVector>(corners.data(), static_cast<int>(corners.size()));
  return cage;
}

// nx x ny unit squares; vertex (i, j) is j * (nx + 1) + i and lies at (i, j, 0), face (i, j) is j * nx + i.
inline PlacedCage grid(int nx, int ny) {
  PlacedCage result;
  std::vector<std::vector<int>> faces;
  result.V.resize((nx + 1) * (ny + 1), 3);
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const int a = j * (nx + 1) + i;
      result.V.row(a) << i, j, 0;
      if (i < nx && j < ny) faces.push_back({a, a + 1, a + nx + 2, a + nx + 1});
    }
  }
  result.cage = polygons(static_cast<int>(result.V.rows()), faces);
  return result;
}

// `valence` quads around vertex 0, flat, with `rings` rings: vertex 0, then sector by sector the (rings x rings) grid
// of each.
inline PlacedCage star(int valence, int rings) {
  PlacedCage result;
  std::vector<std::vector<int>> faces;
  const int block = rings * (rings + 1);  // sector k holds the points a e_k + b e_(k + 1) with a >= 1, b >= 0
  result.V = Positions::Zero(1 + valence * block, 3);
  const auto at = [&](int k, int a, int b) {
    if (a == 0 && b == 0) return 0;
    if (a == 0) return 1 + ((k + 1) % valence) * block + (b - 1) * (rings + 1);
    return 1 + k * block + (a - 1) * (rings + 1) + b;
  };
  for (int k = 0; k < valence; ++k) {
    const double first = 2 * std::numbers::pi * k / valence, second = 2 * std::numbers::pi * (k + 1) / valence;
    for (int a = 1; a <= rings; ++a) {
      for (int b = 0; b <= rings; ++b) {
        result.V.row(at(k, a, b)) << a * cos(first) + b * cos(second), a * sin(first) + b * sin(second), 0;
        if (b < rings) faces.push_back({at(k, a - 1, b), at(k, a, b), at(k, a, b + 1), at(k, a - 1, b + 1)});
      }
    }
  }
  result.cage = polygons(static_cast<int>(result.V.rows()), faces);
  return result;
}

// The cube [-1, 1]^3, faces outwards.
inline PlacedCage cube() {
  PlacedCage result;
  result.V.resize(8, 3);
  for (int i = 0; i < 8; ++i) result.V.row(i) << (i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2 & 1) * 2 - 1;
  result.cage = polygons(8, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
  return result;
}

// A prism over a regular pentagon: two n-gons, five quads, faces outwards.
inline PlacedCage pentagonal_prism() {
  PlacedCage result;
  result.V.resize(10, 3);
  for (int i = 0; i < 5; ++i) {
    result.V.row(i) << cos(0.4 * std::numbers::pi * i), sin(0.4 * std::numbers::pi * i), -1;
    result.V.row(5 + i) << cos(0.4 * std::numbers::pi * i), sin(0.4 * std::numbers::pi * i), 1;
  }
  std::vector<std::vector<int>> faces = {{4, 3, 2, 1, 0}, {5, 6, 7, 8, 9}};
  for (int i = 0; i < 5; ++i) faces.push_back({i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i});
  result.cage = polygons(10, faces);
  return result;
}

// Triangles, faces outwards.
inline PlacedCage octahedron() {
  PlacedCage result;
  result.V.resize(6, 3);
  result.V << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  result.cage = polygons(6, {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
  return result;
}

inline void add_crease(Cage* cage, int first, int second, double sharpness) {
  const int count = static_cast<int>(cage->creases.rows());
  cage->creases.conservativeResize(count + 1, 2);
  cage->creases.row(count) << first, second;
  cage->crease_sharpness.conservativeResize(count + 1);
  cage->crease_sharpness[count] = sharpness;
}

}  // namespace reflines
