// Means over disks in the image plane, with weights 1 - (distance / radius)^2 (the Epanechnikov kernel).
#pragma once

#include <utility>
#include <vector>

#include "reflines/types.h"

namespace reflines {

class DiskMean {
 public:
  // Takes points (#P x 2) and how much each counts (#P, >= 0). Where they are dense, those within an eighth of the
  // radius are merged into their centroid, and means are interpolated between the nodes of a grid.
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

  void sort_by_cell();
  void choose_sources();
  int find_square(int point, const Cell& cell) const;
  Eigen::Map<const Eigen::VectorXi> points_of(Eigen::Index source) const;
  Eigen::ArrayXXd merge(const Eigen::MatrixXd& values) const;
  std::vector<Range> near(const Cell& cell) const;
  Eigen::RowVectorXd sum_around(const Vector2& place, const std::vector<Range>& ranges,
                                const Eigen::ArrayXXd& values) const;
  Eigen::MatrixXd sum_around_nodes(const Cell& cell, const Eigen::ArrayXXd& values) const;
  Eigen::RowVectorXd interpolate(const Eigen::MatrixXd& nodes, const Cell& cell, int point) const;

  double radius_;
  bool interpolated_ = false;
  PlanePositions points_;
  Vector point_weight_;              // #P
  std::vector<int> order_;           // the points, cell by cell
  std::vector<Cell> cells_;          // ascending
  std::vector<Eigen::Index> begin_;  // #cells + 1: where in `order_` the points of each begin

  // The sources: points, or centroids of those that were merged. They are in that order too, so that those of a disk
  // lie in a few runs of memory.
  Eigen::ArrayXd x_, y_, weight_;           // #S
  std::vector<Eigen::Index> merged_;        // #S + 1: where in `order_` the points of each begin
  std::vector<Eigen::Index> source_begin_;  // #cells + 1: where the sources of each begin
};

}  // namespace reflines
