#include "native/geometry/smooth_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace reflines {
namespace {

// Sum of a spline's values below which it would be a nearly empty row (a free corner of the region inside its rim).
constexpr double kSmallestSupport = 1.0;

struct KnotGrid {
  Vector2 origin;
  double step = 0;
  int columns = 0, rows = 0;  // of splines
};

KnotGrid grid_over(const HeightField& field, double spacing) {
  KnotGrid grid;
  grid.step = spacing * std::sqrt(field.area.sum() / std::max(1, field.vertex_count()));
  grid.origin = field.xy.colwise().minCoeff();
  const Vector2 cells = (field.xy.colwise().maxCoeff().transpose() - grid.origin) / grid.step;
  grid.columns = static_cast<int>(cells.x()) + 4;
  grid.rows = static_cast<int>(cells.y()) + 4;
  return grid;
}

// The four uniform cubic B-splines that are not zero at t in [0, 1) of a cell.
std::array<double, 4> cubic_splines(double t) {
  const double s = 1 - t;
  return {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
}

struct Footprint {
  std::array<int, 16> spline;
  std::array<double, 16> value;
};

Footprint footprint(const KnotGrid& grid, const Vector2& xy) {
  const Vector2 place = (xy - grid.origin) / grid.step;
  const int i = static_cast<int>(place.x()), j = static_cast<int>(place.y());
  const auto across = cubic_splines(place.x() - i), along = cubic_splines(place.y() - j);
  Footprint result;
  for (int k = 0; k < 16; ++k) {
    result.spline[k] = (j + k / 4) * grid.columns + i + k % 4;
    result.value[k] = across[k % 4] * along[k / 4];
  }
  return result;
}

// The row of each spline, or -1 where it is left out.
std::vector<int> number_splines(const HeightField& field, const KnotGrid& grid, int& count) {
  std::vector<double> support(static_cast<size_t>(grid.columns) * grid.rows, 0.0);
  std::vector<bool> held(support.size(), false);
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kUnused) continue;
    const Footprint print = footprint(grid, field.xy.row(v));
    for (int k = 0; k < 16; ++k) {
      support[print.spline[k]] += print.value[k];
      if (field.role[v] != VertexRole::kFree && print.value[k] > 0) held[print.spline[k]] = true;
    }
  }
  std::vector<int> row(support.size(), -1);
  for (size_t s = 0; s < row.size(); ++s) {
    if (!held[s] && support[s] >= kSmallestSupport) row[s] = count++;
  }
  return row;
}

}  // namespace

SparseMatrix smooth_modes(const HeightField& field, double spacing) {
  const KnotGrid grid = grid_over(field, spacing);
  int count = 0;
  const std::vector<int> row = number_splines(field, grid, count);
  const auto free = std::count(field.role.begin(), field.role.end(), VertexRole::kFree);
  SparseMatrix modes(count, free);
  modes.reserve(16 * free);
  int column = 0;
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] != VertexRole::kFree) continue;
    const Footprint print = footprint(grid, field.xy.row(v));
    modes.startVec(column);
    for (int k = 0; k < 16; ++k) {
      if (row[print.spline[k]] >= 0) modes.insertBack(row[print.spline[k]], column) = print.value[k];
    }
    ++column;
  }
  modes.finalize();
  return modes;
}

}  // namespace reflines
