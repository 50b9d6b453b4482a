#include "optimization/linear/sparse_columns.h"

#include <algorithm>
#include <map>

namespace reflines {

Eigen::Matrix<double, SparseColumns::kWidth, SparseColumns::kWidth> SparseColumns::transposed_times(
    const Rows& x) const {
  Eigen::Matrix<double, kWidth, kWidth> result = Eigen::Matrix<double, kWidth, kWidth>::Zero();
  for (size_t i = 0; i < row.size(); ++i)
    result.noalias() += value.row(static_cast<Eigen::Index>(i)).transpose() * x.row(row[i]);
  return result;
}

Vector SparseColumns::transposed_times(const Vector& x) const { return value.leftCols(count).transpose() * x(row); }

void SparseColumns::subtract_product(const Eigen::Ref<const Vector>& z, Vector& x) const {
  x(row) -= value.leftCols(count) * z;
}

std::vector<SparseColumns> split_columns(const SparseMatrix& columns) {
  using Row = Eigen::Matrix<double, 1, SparseColumns::kWidth>;
  std::vector<SparseColumns> result;
  for (int first = 0; first < columns.cols(); first += SparseColumns::kWidth) {
    const int count = std::min(SparseColumns::kWidth, static_cast<int>(columns.cols()) - first);
    std::map<int, Row> rows;
    for (int j = 0; j < count; ++j) {
      for (SparseMatrix::InnerIterator entry(columns, first + j); entry; ++entry)
        rows.try_emplace(static_cast<int>(entry.row()), Row::Zero()).first->second(j) = entry.value();
    }
    SparseColumns block{count, {}, SparseColumns::Rows(rows.size(), SparseColumns::kWidth)};
    for (const auto& [row, value] : rows) {
      block.value.row(static_cast<Eigen::Index>(block.row.size())) = value;
      block.row.push_back(row);
    }
    result.push_back(std::move(block));
  }
  return result;
}

}  // namespace reflines
