#include "optimization/linear/sparse_columns.h"

namespace reflines {

Eigen::MatrixXd SparseColumns::transposed_times(const SparseColumns& other) const {
  std::vector<int> here, there;
  for (size_t i = 0, j = 0; i < row.size() && j < other.row.size();) {
    if (row[i] == other.row[j]) {
      here.push_back(static_cast<int>(i++));
      there.push_back(static_cast<int>(j++));
    } else if (row[i] < other.row[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  const Eigen::MatrixXd mine = value(here, Eigen::all), others = other.value(there, Eigen::all);
  return mine.transpose() * others;
}

Vector SparseColumns::transposed_times(const Vector& x) const { return value.transpose() * x(row); }

void SparseColumns::subtract_product(const Vector& z, Vector& x) const { x(row) -= value * z; }

}  // namespace reflines
