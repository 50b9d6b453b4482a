// Columns of a sparse matrix that have one pattern of rows.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// Columns stored as a dense block of the rows in which any of them is not zero.
struct SparseColumns {
  std::vector<int> row;                                                          // ascending
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> value;  // #row x #columns

  Eigen::MatrixXd transposed_times(const SparseColumns& other) const;  // #columns x #columns of the other
  Vector transposed_times(const Vector& x) const;
  void subtract_product(const Vector& z, Vector& x) const;  // x -= columns * z
};

}  // namespace reflines
