// The triangles of a piece that are part of the energy, and their weights.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines {

// The quadrature of a piece: rows 0 .. count - 1 are triangles of the piece. Where all count, `triangle` and `weight`
// are empty.
struct Quadrature {
  std::vector<int> triangle;
  Vector weight;

  bool is_sampled() const { return !triangle.empty(); }
  int triangle_of(int row) const { return triangle.empty() ? row : triangle[row]; }
  double weight_of(int row) const { return triangle.empty() ? 1.0 : weight(row); }
};

// Selects the triangles of `field` with a positive weight; `weight` (one for each of the region's triangles, or empty)
// is that of ShapeOptions.
Quadrature make_quadrature(const HeightField& field, const Vector& weight);

}  // namespace reflines
