// A coarse basis of height changes: bicubic B-splines over the image plane, evaluated at the free vertices.
#pragma once

#include <array>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines {

// A triangle that stands for its neighbours.
struct SplineSample {
  int triangle = -1;
  double area_ratio = 0.0;  // area it stands for / its own area
  Vector2 place;            // of its centroid within the cell, in [0, 1)^2
};

// A cell of the knots' grid that holds samples: begin .. end - 1, and the splines that are not zero there.
struct SplineCell {
  int begin = 0, end = 0;
  std::array<int, 16> mode;  // or -1 where a spline is left out
};

// Knots one cell apart; splines are numbered row by row.
struct KnotGrid {
  Vector2 origin;
  double step = 0;            // width of a cell
  int columns = 0, rows = 0;  // of splines; cells are three fewer each way
};

struct SplineBasis {
  KnotGrid grid;
  std::vector<int> mode;  // of each spline, or -1 where it is left out
  int count = 0;          // m
  PlanePositions places;  // n x 2: of each free vertex in order, in the image plane
  std::vector<SplineCell> cells;
  std::vector<SplineSample> samples;  // one for every ninth of a cell that holds a triangle

  // With P, n x m, by how much each mode moves the free vertices. It is not kept: 16 entries a vertex are 200 MB at 1M
  // vertices, and take longer to write and read than to compute.
  void move(const Vector& c, Vector& x) const;     // x += P c
  Vector pull_back(const Vector& gradient) const;  // P^T gradient
};

// The knots lie about `spacing` mean vertex distances apart. A spline that would move a vertex which is not free is
// left out, so that borders keep their position and tangent; so is one that hardly moves any. There may be none at all.
SplineBasis build_spline_basis(const HeightField& field, double spacing);

// What a cell's 16 splines are at a place of it, one a column: value, f_x, f_y, f_xx, f_xy, f_yy.
using SplineDerivatives = Eigen::Matrix<double, 6, 16>;
SplineDerivatives spline_derivatives(const Vector2& place, double step);

}  // namespace reflines
