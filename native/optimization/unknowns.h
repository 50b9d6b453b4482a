// The affine map z = B x + c from unknowns to heights: fixed vertices, symmetry pairs and subdivision cages are all
// this.
#pragma once

#include <vector>

#include "native/types.h"

namespace reflines {

class Unknowns {
 public:
  // One unknown for every vertex whose `is_free` is set, in order; the others keep their height in z (#V).
  static Unknowns free_vertices(const Mask& is_free, const Vector& z);

  // Any B (#V x n) with the start x (n) that gives the heights z (#V): c = z - B x.
  Unknowns(const SparseMatrix& B, Vector x, const Vector& z);

  int size() const { return static_cast<int>(start_.size()); }
  const Vector& start() const { return start_; }

  // #V: the number of a vertex among those that move, 0 .. moving_count() - 1 in order, or -1. Of a selection of
  // vertices it is the unknown that is the vertex's height.
  const std::vector<int>& column() const { return column_; }
  int moving_count() const { return moving_count_; }

  // Empty for a selection, else B^T over the moving vertices, n x #moving.
  const SparseMatrix& modes() const { return modes_; }

  void heights(const Vector& x, Vector& z) const;  // z = B x + c; bits of heights that no unknown moves are kept
  void pull_back(const Vector& along_z, Vector& along_x) const;  // B^T

 private:
  Unknowns() = default;

  // One orientation for each product: Eigen runs products whose sums lie in a row of memory on all cores, and each sum
  // on one of them.
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> rows_;        // B, #V x n; empty for a selection
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> transposed_;  // B^T
  SparseMatrix modes_;
  std::vector<int> column_;
  int moving_count_ = 0;
  Vector start_;   // n
  Vector offset_;  // #V: c, or for a selection the heights of the fixed vertices
};

}  // namespace reflines
