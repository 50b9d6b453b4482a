#include "following/coupled_sum.h"

#include <algorithm>

namespace reflines {

CoupledSum::CoupledSum(const SplineWindow& window)
    : window_(window),
      bandwidth_(window.bandwidth()),
      width_(2 * bandwidth_ + 1),
      matrix_(window.count(), window.count()) {
  values_.assign(static_cast<size_t>(window.count()) * (bandwidth_ + 1) * width_, 0.0);
  const std::vector<int>& spline = window.spline_of_mode();
  for (const int own : spline) {
    across_.push_back(own % window.columns());
    along_.push_back(own / window.columns());
  }
  for (int column = 0; column < window.count(); ++column) {
    matrix_.startVec(column);
    const int own = across_[column];
    for (int k = 0; k < (bandwidth_ + 1) * width_; ++k) {
      const int across = k % width_ - bandwidth_, along = k / width_;
      if (along == 0 && across < 0) continue;
      if (own + across < 0 || own + across >= window.columns()) continue;
      const auto found =
          std::lower_bound(spline.begin(), spline.end(), spline[column] + along * window.columns() + across);
      if (found == spline.end() || *found != spline[column] + along * window.columns() + across) continue;
      matrix_.insertBack(static_cast<int>(found - spline.begin()), column) = 0.0;
      source_.push_back(static_cast<size_t>(column) * (bandwidth_ + 1) * width_ + k);
    }
  }
  matrix_.finalize();
}

void CoupledSum::clear() {
  std::fill(values_.begin(), values_.end(), 0.0);
  diagonal_ = 0.0;
}

size_t CoupledSum::place(int row, int column) const {
  return (static_cast<size_t>(column) * (bandwidth_ + 1) + along_[row] - along_[column]) * width_ + across_[row] -
         across_[column] + bandwidth_;
}

void CoupledSum::add(const std::vector<int>& mode, const Eigen::Ref<const Eigen::MatrixXd>& block) {
  for (size_t j = 0; j < mode.size(); ++j) {
    for (size_t i = j; i < mode.size(); ++i) {
      values_[place(mode[i], mode[j])] += block(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
}

void CoupledSum::add(const ModeRow& row, double weight) {
  for (size_t j = 0; j < row.mode.size(); ++j) {
    for (size_t i = j; i < row.mode.size(); ++i) {
      values_[place(row.mode[i], row.mode[j])] += weight * row.value[i] * row.value[j];
    }
  }
}

double CoupledSum::mean_diagonal() const {
  double sum = 0;
  for (int k = 0; k < window_.count(); ++k) sum += values_[place(k, k)];
  return sum / std::max(1, window_.count());
}

const SparseMatrix& CoupledSum::matrix() {
  for (size_t k = 0; k < source_.size(); ++k) matrix_.valuePtr()[k] = values_[source_[k]];
  for (int column = 0; column < matrix_.cols(); ++column) {
    matrix_.valuePtr()[matrix_.outerIndexPtr()[column]] += diagonal_;
  }
  return matrix_;
}

}  // namespace reflines
