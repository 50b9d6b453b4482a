// The affine map z = B x + c from unknowns to heights. Fixed vertices, symmetry pairs and subdivision cages are all of
// this form.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

class AffineMap {
 public:
  // Builds a selection: every vertex moves as one unknown does, or stays at its height in z (#V). `leader` (#V) is the
  // vertex whose height is that unknown: the vertex itself, or its mirror image; -1 where the vertex stays. Unknowns
  // are in the order of their vertices.
  static AffineMap select_vertices(const std::vector<int>& leader, const Vector& z);

  // Takes any B (#V x n) with the start x (n) that gives the heights z (#V): c = z - B x.
  AffineMap(const SparseMatrix& B, Vector x, const Vector& z);

  int size() const { return static_cast<int>(start_.size()); }
  const Vector& start() const { return start_; }
  bool is_selection() const { return moving_transposed_.size() == 0; }

  // Returns for each vertex (#V) the row of the Hessian over moving heights that it contributes to, 0 .. moving_count()
  // - 1, or -1 where it stays. In a selection that is the vertex's unknown, else its index among the vertices that
  // move.
  const std::vector<int>& moving_index() const { return moving_index_; }
  int moving_count() const { return moving_count_; }

  // Returns of a selection the vertex whose height is each unknown (n), and whether others move with these.
  const std::vector<int>& leaders() const { return leaders_; }
  bool has_followers() const { return has_followers_; }

  // Returns B^T over the moving vertices (n x #moving); empty for a selection.
  const SparseMatrix& moving_transposed() const { return moving_transposed_; }

  // Writes z = B x + c; heights that no unknown moves keep their bits.
  void apply(const Vector& x, Vector& z) const;
  // Writes the gradient with respect to x, B^T g, of a gradient g with respect to z.
  void pull_back(const Vector& along_z, Vector& along_x) const;

 private:
  AffineMap() = default;

  // Both orientations, one for each product: Eigen runs products whose sums lie in a row of memory on all cores, and
  // each sum on one of them.
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> rows_;        // B, #V x n; empty for a selection
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> transposed_;  // B^T
  SparseMatrix moving_transposed_;
  std::vector<int> moving_index_;
  int moving_count_ = 0;
  std::vector<int> leaders_;  // n; empty where this is no selection
  bool has_followers_ = false;
  Vector start_;   // n
  Vector offset_;  // #V: c
};

}  // namespace reflines
