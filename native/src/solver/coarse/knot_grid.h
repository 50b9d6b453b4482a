// A uniform grid of knots over the image plane, and its bicubic B-splines.
#pragma once

#include <array>

#include "reflines/types.h"

namespace reflines {

// The grid of knots, one cell apart; splines are numbered row by row.
struct KnotGrid {
  Vector2 origin;
  double step = 0;            // width of a cell
  int columns = 0, rows = 0;  // numbers of splines; cells are three fewer in each direction
};

// The splines that are not zero at a place, and their values there.
struct Footprint {
  std::array<int, 16> spline;
  std::array<double, 16> value;
};

// Returns a place in cells from the grid's origin.
Vector2 in_cells(const KnotGrid& grid, const Vector2& xy);

// Returns the splines that are not zero in a cell, by its column and row.
std::array<int, 16> splines_of_cell(const KnotGrid& grid, int i, int j);

// Returns the footprint of a place within the cells.
Footprint footprint(const KnotGrid& grid, const Vector2& xy);

// Returns the value, f_x, f_y, f_xx, f_xy, f_yy of a cell's 16 splines at a place of it, one a column.
using SplineDerivatives = Eigen::Matrix<double, 6, 16>;
SplineDerivatives spline_derivatives(const Vector2& place, double step);

}  // namespace reflines
