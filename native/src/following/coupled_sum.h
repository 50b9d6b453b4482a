// Sums of small symmetric matrices over nearby motions of a window, as one sparse matrix of constant pattern.
#pragma once

#include <vector>

#include "following/spline_window.h"
#include "reflines/types.h"

namespace reflines {

class CoupledSum {
 public:
  explicit CoupledSum(const SplineWindow& window);

  void clear();
  // Adds the lower triangle of `block` over these motions, which ascend.
  void add(const std::vector<int>& mode, const Eigen::Ref<const Eigen::MatrixXd>& block);
  void add(const ModeRow& row, double weight);  // weight times the row's square
  void add_to_diagonal(double value) { diagonal_ += value; }
  double mean_diagonal() const;

  const SparseMatrix& matrix();  // lower triangle; overwritten by the next call

 private:
  size_t place(int row, int column) const;

  const SplineWindow& window_;
  int bandwidth_, width_;
  std::vector<int> across_, along_;  // column and row of each motion among the knots
  std::vector<double> values_;       // of each column the rows at and after it, within bandwidth
  std::vector<size_t> source_;       // in values_, of each entry of matrix_
  double diagonal_ = 0.0;
  SparseMatrix matrix_;
};

}  // namespace reflines
