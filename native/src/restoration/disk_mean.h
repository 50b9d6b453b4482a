// Means over disks in the image plane, with weights 1 - (distance / radius)^2 (the Epanechnikov kernel).
#pragma once

#include <utility>
#include <vector>

#include "reflines/types.h"

namespace reflines {

class DiskMean {
 public:
  // Points (#P x 2) and how much each counts (#P, >= 0); keeps no reference to them.
  DiskMean(const PlanePositions& points, const Vector& weight, double radius);

  // Returns the mean of `values` (#P) around each point (#P); the value itself where nothing around it counts.
  Vector of(const Vector& values) const { return of_columns(values); }

  // Returns the means of each column of `values` (#P x n); the kernel is evaluated once for all of them.
  Eigen::MatrixXd of_columns(const Eigen::MatrixXd& values) const;

 private:
  using Cell = std::pair<int, int>;
  struct Range {
    Eigen::Index begin, size;
  };

  void sort_by_cell(const PlanePositions& points);
  std::vector<Range> near(const Cell& cell) const;

  double radius_;
  std::vector<int> order_;           // the points, cell by cell
  Eigen::ArrayXd x_, y_, weight_;    // #P, in that order, so that the points of a disk lie in a few runs of memory
  std::vector<Cell> cells_;          // ascending
  std::vector<Eigen::Index> begin_;  // #cells + 1: where the points of each begin
};

}  // namespace reflines
