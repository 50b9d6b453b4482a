#include "optimization/linear/dense_front.h"

#include <algorithm>
#include <vector>

#include "optimization/linear/blas.h"

namespace reflines {
namespace {

// The columns factored at once, and the rows and columns of a tile.
constexpr int kTile = 192;

struct Tile {
  int row, column, rows, columns;
};

// Returns tiles of the lower part of a trapezoid (rows x columns, at least as many rows). A tile at the diagonal is
// square; without `split` all rows below it are one.
std::vector<Tile> cut_into_tiles(int rows, int columns, bool split) {
  std::vector<Tile> tiles;
  for (int column = 0; column < columns; column += kTile) {
    const int width = std::min(kTile, columns - column);
    tiles.push_back({column, column, width, width});
    const int height = split ? kTile : rows;
    for (int row = column + width; row < rows; row += height)
      tiles.push_back({row, column, std::min(height, rows - row), width});
  }
  return tiles;
}

// A trapezoid C of a front from which A A^T is subtracted (A: rows x depth).
struct Product {
  const double* A;
  int stride, depth;
  double* C;
  int stride_c, rows, columns;

  void subtract(const Tile& tile) const {
    const double minus = -1.0, one = 1.0;
    const double *left = A + tile.row, *right = A + tile.column;
    double* to = C + static_cast<long long>(tile.column) * stride_c + tile.row;
    if (tile.row == tile.column)
      dsyrk_("L", "N", &tile.columns, &depth, &minus, left, &stride, &one, to, &stride_c);
    else
      dgemm_("N", "T", &tile.rows, &tile.columns, &depth, &minus, left, &stride, right, &stride, &one, to, &stride_c);
  }

  void subtract(bool split) const {
    const std::vector<Tile> tiles = cut_into_tiles(rows, columns, split);
    if (!split) {
      for (const Tile& tile : tiles) subtract(tile);
      return;
    }
#pragma omp parallel for schedule(dynamic)
    for (int t = 0; t < static_cast<int>(tiles.size()); ++t) subtract(tiles[t]);
  }
};

// Solves for `count` rows of the columns from `first` on, whose diagonal block is factored.
void solve_rows(const DenseFront& front, int first, int width, int row, int count) {
  const int stride = front.height();
  const double one = 1.0;
  dtrsm_("R", "L", "T", "N", &count, &width, &one, front.at(first, first), &stride, front.at(row, first), &stride);
}

// Factors `width` columns, to which nothing is left to add, and the rows below them.
bool factorize_panel(const DenseFront& front, int first, int width, bool split) {
  const int height = front.height(), below = first + width;
  int info = 0;
  dpotrf_("L", &width, front.at(first, first), &height, &info);
  if (info != 0) return false;
  if (!split) {
    if (below < height) solve_rows(front, first, width, below, height - below);
    return true;
  }
#pragma omp parallel for schedule(dynamic)
  for (int row = below; row < height; row += kTile) solve_rows(front, first, width, row, std::min(kTile, height - row));
  return true;
}

}  // namespace

bool factorize_front(const DenseFront& front, bool split) {
  const int columns = front.columns, height = front.height();
  for (int first = 0; first < columns; first += kTile) {
    const int width = std::min(kTile, columns - first), next = first + width;
    if (!factorize_panel(front, first, width, split)) return false;
    const Product rest{front.at(next, first), height,        width, front.at(next, next), height,
                       height - next,         columns - next};
    if (next < columns) rest.subtract(split);
  }
  const Product update{front.at(columns, 0), height, columns, front.update, front.below, front.below, front.below};
  if (front.below > 0) update.subtract(split);
  return true;
}

}  // namespace reflines
