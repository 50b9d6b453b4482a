// Targets that warp the lines by a map of the image plane (paper, section 4, "Warping"; Figures 8 and 10).
#pragma once

#include "reflines/region_field.h"
#include "reflines/target.h"

namespace reflines {

// A sampled map w of the image plane: the rest positions are the (columns + 1) x (rows + 1) nodes of a regular grid
// over the rectangle low .. high, x running fastest; `position` (#nodes x 2) holds their images. Between nodes w is
// linear on the two triangles of a cell; outside the rectangle it is the identity.
struct WarpGrid {
  Vector2 low, high;
  int columns = 0, rows = 0;
  PlanePositions position;
};

// Builds the target theta_warp with theta_warp(w(s)) = theta(s): the current field plus the gradient of Delta theta =
// theta_warp - theta, taken at the vertices, wrapped to (-pi, pi] and differentiated per triangle (eq. 5). The identity
// changes no bit.
//
// The paper renders theta to a texture and the texture through the grid. Here w is inverted exactly on the sampled
// grid, and theta is evaluated on the mesh by a blend that is exact on quadratics, sum_i b_i (theta_i + grad theta_i (y
// - x_i) / 2): linear interpolation has an error as large as the change by a small warp. With `by_value` the target
// fits theta itself (eq. 3). Throws InvalidInput where the grid folds over. Triangles that would show lines from
// outside the region, of a feature (field.feature) or of another piece have weight `kOutsideWeight` and are counted in
// `outside`; features keep their own lines.
struct WarpResult {
  Target target;
  int outside = 0;
};
constexpr double kOutsideWeight = 1e-3;

WarpResult build_warp_target(const RegionField& field, const WarpGrid& grid, bool by_value);

}  // namespace reflines
