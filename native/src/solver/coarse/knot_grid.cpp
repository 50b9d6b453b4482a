#include "solver/coarse/knot_grid.h"

namespace reflines {
namespace {

// The four uniform cubic B-splines that are not zero at t in [0, 1) of a cell; rows are the value and the first and
// second derivative.
using Splines = Eigen::Matrix<double, 3, 4>;
Splines cubic_splines(double t) {
  const double s = 1 - t;
  Splines result;
  result << s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6,  //
      -s * s / 2, (3 * t * t - 4 * t) / 2, (4 * s - 3 * s * s) / 2, t * t / 2,                                       //
      s, 3 * t - 2, 3 * s - 2, t;
  return result;
}

}  // namespace

Vector2 in_cells(const KnotGrid& grid, const Vector2& xy) { return (xy - grid.origin) / grid.step; }

std::array<int, 16> splines_of_cell(const KnotGrid& grid, int i, int j) {
  std::array<int, 16> result;
  for (int k = 0; k < 16; ++k) result[k] = (j + k / 4) * grid.columns + i + k % 4;
  return result;
}

Footprint footprint(const KnotGrid& grid, const Vector2& xy) {
  const Vector2 place = in_cells(grid, xy);
  const int i = static_cast<int>(place.x()), j = static_cast<int>(place.y());
  const Splines across = cubic_splines(place.x() - i), along = cubic_splines(place.y() - j);
  Footprint result{splines_of_cell(grid, i, j), {}};
  for (int k = 0; k < 16; ++k) result.value[k] = across(0, k % 4) * along(0, k / 4);
  return result;
}

SplineDerivatives spline_derivatives(const Vector2& place, double step) {
  const Splines across = cubic_splines(place.x()), along = cubic_splines(place.y());
  const double one = 1 / step, two = one * one;
  SplineDerivatives result;
  for (int k = 0; k < 16; ++k) {
    const auto a = across.col(k % 4), b = along.col(k / 4);
    result.col(k) << a(0) * b(0), one * a(1) * b(0), one * a(0) * b(1), two * a(2) * b(0), two * a(1) * b(1),
        two * a(0) * b(2);
  }
  return result;
}

}  // namespace reflines
