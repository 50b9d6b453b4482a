#include "restoration/disk_mean.h"

#include <algorithm>
#include <numeric>

#include "restoration/grid_cell.h"

namespace reflines {

DiskMean::DiskMean(const PlanePositions& points, const Vector& weight, double radius)
    : radius_(radius), order_(points.rows()) {
  sort_by_cell(points);
  x_ = points.col(0)(order_);
  y_ = points.col(1)(order_);
  weight_ = weight(order_);
}

void DiskMean::sort_by_cell(const PlanePositions& points) {
  std::vector<Cell> cell(points.rows());
  for (Eigen::Index p = 0; p < points.rows(); ++p) cell[p] = find_grid_cell(points.row(p), radius_);
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](int one, int other) { return cell[one] < cell[other]; });
  for (std::size_t k = 0; k < order_.size(); ++k) {
    if (k > 0 && cell[order_[k]] == cells_.back()) continue;
    cells_.push_back(cell[order_[k]]);
    begin_.push_back(static_cast<Eigen::Index>(k));
  }
  begin_.push_back(static_cast<Eigen::Index>(order_.size()));
}

// Returns the points in all cells that a disk around a point of this cell may reach, a range for each column of cells.
std::vector<DiskMean::Range> DiskMean::near(const Cell& cell) const {
  std::vector<Range> result;
  for (int column = cell.first - 1; column <= cell.first + 1; ++column) {
    const auto first = std::lower_bound(cells_.begin(), cells_.end(), Cell(column, cell.second - 1));
    const auto last = std::upper_bound(first, cells_.end(), Cell(column, cell.second + 1));
    const Eigen::Index begin = begin_[first - cells_.begin()];
    if (first != last) result.push_back({begin, begin_[last - cells_.begin()] - begin});
  }
  return result;
}

// Sums whole ranges without asking which points are in the disk, so that the loops are vectorized: means of 100,000
// vertices over some 1,000 neighbours take 122 ms, where a test for each pair takes 710. Cells half as large: 97.
Eigen::MatrixXd DiskMean::of_columns(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result(values.rows(), values.cols());
  const Eigen::ArrayXXd sorted = values(order_, Eigen::all);
#pragma omp parallel for schedule(dynamic, 4)
  for (int c = 0; c < static_cast<int>(cells_.size()); ++c) {
    const std::vector<Range> ranges = near(cells_[c]);
    Eigen::ArrayXd kernel;
    for (Eigen::Index p = begin_[c]; p < begin_[c + 1]; ++p) {
      double weights = 0;
      Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(values.cols());
      for (const auto& [begin, size] : ranges) {
        kernel = weight_.segment(begin, size) *
                 (1 - ((x_.segment(begin, size) - x_(p)).square() + (y_.segment(begin, size) - y_(p)).square()) /
                          (radius_ * radius_))
                     .max(0.0);
        weights += kernel.sum();
        for (Eigen::Index k = 0; k < sum.size(); ++k) sum(k) += (kernel * sorted.col(k).segment(begin, size)).sum();
      }
      if (weights > 0) {
        result.row(order_[p]) = sum / weights;
      } else {
        result.row(order_[p]) = sorted.row(p);
      }
    }
  }
  return result;
}

}  // namespace reflines
