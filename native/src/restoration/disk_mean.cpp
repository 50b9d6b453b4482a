#include "restoration/disk_mean.h"

#include <algorithm>
#include <numeric>

#include "base/parallel_failure.h"
#include "restoration/grid_cell.h"

namespace reflines {
namespace {

// Points are merged in squares, so many along each side of a cell: means of a smooth function are wrong by 0.003 of
// its spread.
constexpr int kSquares = 8;

// The number of nodes along each side of a cell around which sums are taken, and between which they are interpolated,
// where points are more than these nodes: means of a smooth function are wrong by 0.005 of its spread, merging
// included.
constexpr int kNodes = 12;
constexpr double kSpacing = 1.0 / kNodes;  // radii
constexpr Eigen::Index kCorners = (kNodes + 1) * (kNodes + 1);

// The number of points in a cell, in the mean, above which they are merged: twice that of its squares.
constexpr Eigen::Index kDense = 2 * kSquares * kSquares;

}  // namespace

DiskMean::DiskMean(const PlanePositions& points, const Vector& weight, double radius)
    : radius_(radius), points_(points), point_weight_(weight), order_(points.rows()) {
  sort_by_cell();
  choose_sources();
  interpolated_ = points_.rows() > kCorners * static_cast<Eigen::Index>(cells_.size());
  const Eigen::ArrayXXd centroids = merge(points_);
  x_ = centroids.col(0);
  y_ = centroids.col(1);
  weight_.resize(x_.size());
  for (Eigen::Index s = 0; s < x_.size(); ++s) weight_(s) = point_weight_(points_of(s)).sum();
}

void DiskMean::sort_by_cell() {
  std::vector<Cell> cell(points_.rows());
  for (Eigen::Index p = 0; p < points_.rows(); ++p) cell[p] = find_grid_cell(points_.row(p), radius_);
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](int one, int other) { return cell[one] < cell[other]; });
  for (std::size_t k = 0; k < order_.size(); ++k) {
    if (k > 0 && cell[order_[k]] == cells_.back()) continue;
    cells_.push_back(cell[order_[k]]);
    begin_.push_back(static_cast<Eigen::Index>(k));
  }
  begin_.push_back(static_cast<Eigen::Index>(order_.size()));
}

// Makes each point a source, or, where they are dense, those in each square of a cell together.
void DiskMean::choose_sources() {
  const bool dense = points_.rows() > kDense * static_cast<Eigen::Index>(cells_.size());
  std::vector<int> square(points_.rows());
  std::iota(square.begin(), square.end(), 0);
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto first = order_.begin() + begin_[c], last = order_.begin() + begin_[c + 1];
    if (dense) {
      std::for_each(first, last, [&](int p) { square[p] = find_square(p, cells_[c]); });
      std::stable_sort(first, last, [&](int one, int other) { return square[one] < square[other]; });
    }
    source_begin_.push_back(static_cast<Eigen::Index>(merged_.size()));
    for (auto p = first; p != last; ++p) {
      if (p == first || square[*p] != square[*(p - 1)]) merged_.push_back(p - order_.begin());
    }
  }
  source_begin_.push_back(static_cast<Eigen::Index>(merged_.size()));
  merged_.push_back(static_cast<Eigen::Index>(order_.size()));
}

// Returns in which square of its cell a point lies.
int DiskMean::find_square(int point, const Cell& cell) const {
  const auto place = [&](double x, int of_cell) {
    return static_cast<int>(kSquares * std::clamp(x / radius_ - of_cell, 0.0, 1.0));
  };
  return (kSquares + 1) * place(points_(point, 0), cell.first) + place(points_(point, 1), cell.second);
}

// Returns the points that are merged to a source.
Eigen::Map<const Eigen::VectorXi> DiskMean::points_of(Eigen::Index source) const {
  return {order_.data() + merged_[source], merged_[source + 1] - merged_[source]};
}

// Returns means of `values` (#P x n) over the points of each source (#S x n).
Eigen::ArrayXXd DiskMean::merge(const Eigen::MatrixXd& values) const {
  Eigen::ArrayXXd result(static_cast<Eigen::Index>(merged_.size()) - 1, values.cols());
  for (Eigen::Index s = 0; s < result.rows(); ++s) {
    const auto points = points_of(s);
    const Vector weight = point_weight_(points);
    const double weights = weight.sum();
    if (points.size() == 1 || !(weights > 0)) {
      result.row(s) = values.row(points[0]);
    } else {
      result.row(s) = (weight / weights).transpose() * values(points, Eigen::all);
    }
  }
  return result;
}

// Returns the sources in all cells that a disk around a point of this cell may touch, a range for each column of cells.
std::vector<DiskMean::Range> DiskMean::near(const Cell& cell) const {
  std::vector<Range> result;
  for (int column = cell.first - 1; column <= cell.first + 1; ++column) {
    const auto first = std::lower_bound(cells_.begin(), cells_.end(), Cell(column, cell.second - 1));
    const auto last = std::upper_bound(first, cells_.end(), Cell(column, cell.second + 1));
    const Eigen::Index begin = source_begin_[first - cells_.begin()];
    if (first != last) result.push_back({begin, source_begin_[last - cells_.begin()] - begin});
  }
  return result;
}

// Returns the sums of kernel times weight times values, and without values in the last entry, of a disk around a place.
// Whole ranges are summed without asking which sources are in the disk, so that the loops are vectorized: means of
// 100,000 vertices over some 1,000 neighbours take 122 ms, where a test for each pair takes 710.
Eigen::RowVectorXd DiskMean::sum_around(const Vector2& place, const std::vector<Range>& ranges,
                                        const Eigen::ArrayXXd& values) const {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(values.cols() + 1);
  Eigen::ArrayXd kernel;
  for (const auto& [begin, size] : ranges) {
    kernel = weight_.segment(begin, size) *
             (1 - ((x_.segment(begin, size) - place.x()).square() + (y_.segment(begin, size) - place.y()).square()) /
                      (radius_ * radius_))
                 .max(0.0);
    for (Eigen::Index n = 0; n < values.cols(); ++n) sum(n) += (kernel * values.col(n).segment(begin, size)).sum();
    sum(values.cols()) += kernel.sum();
  }
  return sum;
}

// Returns such sums around the nodes of a cell (kCorners x (n + 1)).
Eigen::MatrixXd DiskMean::sum_around_nodes(const Cell& cell, const Eigen::ArrayXXd& values) const {
  const std::vector<Range> ranges = near(cell);
  Eigen::MatrixXd result(kCorners, values.cols() + 1);
  for (int i = 0; i <= kNodes; ++i) {
    for (int j = 0; j <= kNodes; ++j) {
      const Vector2 node = radius_ * Vector2(cell.first + i * kSpacing, cell.second + j * kSpacing);
      result.row(i * (kNodes + 1) + j) = sum_around(node, ranges, values);
    }
  }
  return result;
}

// Interpolates the sums around the nodes of a cell bilinearly at a point in it: the sums of a kernel that is hardly
// another one, and not below 0.
Eigen::RowVectorXd DiskMean::interpolate(const Eigen::MatrixXd& nodes, const Cell& cell, int point) const {
  const auto place = [&](double x, int of_cell) { return kNodes * std::clamp(x / radius_ - of_cell, 0.0, 1.0); };
  const double x = place(points_(point, 0), cell.first), y = place(points_(point, 1), cell.second);
  const int i = std::min(static_cast<int>(x), kNodes - 1), j = std::min(static_cast<int>(y), kNodes - 1);
  const int node = i * (kNodes + 1) + j, next = node + kNodes + 1;
  return (i + 1 - x) * ((j + 1 - y) * nodes.row(node) + (y - j) * nodes.row(node + 1)) +
         (x - i) * ((j + 1 - y) * nodes.row(next) + (y - j) * nodes.row(next + 1));
}

Eigen::MatrixXd DiskMean::of_columns(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result(values.rows(), values.cols());
  const Eigen::ArrayXXd merged = merge(values);
  run_parallel(static_cast<int>(cells_.size()), 4, [&](int c) {
    const std::vector<Range> ranges = near(cells_[c]);
    const Eigen::MatrixXd nodes = interpolated_ ? sum_around_nodes(cells_[c], merged) : Eigen::MatrixXd();
    for (Eigen::Index k = begin_[c]; k < begin_[c + 1]; ++k) {
      const int p = order_[k];
      const Eigen::RowVectorXd sum =
          interpolated_ ? interpolate(nodes, cells_[c], p) : sum_around(points_.row(p), ranges, merged);
      const double weights = sum(values.cols());
      if (weights > 0) {
        result.row(p) = sum.head(values.cols()) / weights;
      } else {
        result.row(p) = values.row(p);
      }
    }
  });
  return result;
}

}  // namespace reflines
