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
  Unknowns(SparseMatrix B, Vector x, const Vector& z);

  int size() const { return static_cast<int>(start_.size()); }
  const Vector& start() const { return start_; }
  const SparseMatrix& matrix() const { return B_; }

  // #V: the unknown that is the vertex's height, or -1; empty where B is not a selection of vertices.
  const std::vector<int>& column() const { return column_; }

  void heights(const Vector& x, Vector& z) const;  // z = B x + c; bits of heights that no unknown moves are kept
  void pull_back(const Vector& along_z, Vector& along_x) const;  // B^T

 private:
  Unknowns() = default;

  SparseMatrix B_;           // empty for a selection
  std::vector<int> column_;  // #V
  Vector start_;             // n
  Vector offset_;            // #V: c, or for a selection the heights of the fixed vertices
};

}  // namespace reflines
