// A coarse basis of height changes: bicubic B-splines over the image plane, evaluated at the free vertices.
#pragma once

#include <array>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"

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

// The grid of knots, one cell apart; splines are numbered row by row.
struct KnotGrid {
  Vector2 origin;
  double step = 0;            // width of a cell
  int columns = 0, rows = 0;  // numbers of splines; cells are three fewer in each direction
};

struct SplineBasis {
  KnotGrid grid;
  std::vector<int> mode;  // of each spline, or -1 where it is left out
  int count = 0;          // m
  PlanePositions places;  // n x 2: of each free vertex in order, in the image plane
  std::vector<SplineCell> cells;
  std::vector<SplineSample> samples;  // one for every ninth of a cell that holds a triangle

  // Products with P (n x m), the moves of the free vertices by each mode. P is not stored: 16 entries a vertex are 200
  // MB at 1M vertices, and take longer to write and read than to compute.
  void move(const Vector& c, Vector& x) const;     // x += P c
  Vector pull_back(const Vector& gradient) const;  // P^T gradient
};

// Builds the basis with knots about `spacing` mean vertex distances apart. A spline that would move a vertex which is
// not free is left out, so that borders keep their position and tangent; so is one that hardly moves any. The basis may
// be empty.
SplineBasis build_spline_basis(const HeightField& field, double spacing);

// Returns the value, f_x, f_y, f_xx, f_xy, f_yy of a cell's 16 splines at a place of it, one a column.
using SplineDerivatives = Eigen::Matrix<double, 6, 16>;
SplineDerivatives spline_derivatives(const Vector2& place, double step);

}  // namespace reflines
