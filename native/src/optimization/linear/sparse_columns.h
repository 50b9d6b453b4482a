// Some columns of a sparse matrix that have one pattern of rows.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// Up to eight columns stored as a dense block of the rows in which any of them is not zero: of neighbours, whose rows
// are nearly the same. Blocks are read for each product: with four columns products take a third longer.
struct SparseColumns {
  static constexpr int kWidth = 8;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kWidth, Eigen::RowMajor>;

  int count;             // of columns; the others of `value` are 0
  std::vector<int> row;  // ascending
  Rows value;            // #row x kWidth

  Eigen::Matrix<double, kWidth, kWidth> transposed_times(const Rows& x) const;  // x: n x kWidth
  Vector transposed_times(const Vector& x) const;                               // #columns
  void subtract_product(const Eigen::Ref<const Vector>& z, Vector& x) const;    // x -= columns * z
};

// Returns the blocks of all columns, in their order.
std::vector<SparseColumns> split_columns(const SparseMatrix& columns);

}  // namespace reflines
