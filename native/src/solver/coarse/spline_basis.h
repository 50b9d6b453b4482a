// A coarse basis of height changes: bicubic B-splines over the image plane, evaluated at the free vertices.
#pragma once

#include <array>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"
#include "solver/coarse/knot_grid.h"

namespace reflines {

// A triangle that stands for its neighbours in the sampled energy.
struct SplineSample {
  int triangle = -1;
  double area_ratio = 0.0;  // represented area / own area
  Vector2 place;            // of its centroid within the cell, in [0, 1)^2
};

// A cell of the knots' grid that contains samples: begin .. end - 1, and the splines that are not zero there.
struct SplineCell {
  int begin = 0, end = 0;
  std::array<int, 16> mode;  // or -1 where a spline is left out
};

struct SplineBasis {
  KnotGrid grid;
  std::vector<int> mode;  // of each spline, or -1 where it is left out
  int count = 0;          // m
  PlanePositions places;  // n x 2: of each unknown's vertex in order, in the image plane; built for all free vertices
  PlanePositions images;  // n x 2: of the vertex that moves with it, itself where there is none; empty: none do
  std::vector<SplineCell> cells;
  std::vector<SplineSample> samples;  // one for every ninth of a cell that holds a triangle

  // Products with P (n x m), the moves of the unknowns by each mode: those of their vertices, in the mean. P is not
  // stored: 16 entries a vertex are 200 MB at 1M vertices, and take longer to write and read than to compute.
  void move(const Vector& c, Vector& x) const;     // x += P c
  Vector pull_back(const Vector& gradient) const;  // P^T gradient

 private:
  double vertex_weight() const { return images.rows() > 0 ? 0.5 : 1.0; }
  void add_move(const Vector2& place, const Vector& c, double& x) const;
  void add_gradient(const Vector2& place, double gradient, Vector& result) const;
};

// Builds the basis with knots about `spacing` mean vertex distances apart. A spline that would move a vertex which is
// not free is left out, so that borders keep their position and tangent; so is one that hardly moves any. The basis may
// be empty.
SplineBasis build_spline_basis(const HeightField& field, double spacing);

}  // namespace reflines
