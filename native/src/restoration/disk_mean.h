// Means over disks in the image plane, with weights 1 - (distance / radius)^2 (the Epanechnikov kernel).
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "reflines/types.h"

namespace reflines {

class DiskMean {
 public:
  // Points p (#P x 2) and how much each counts (#P, >= 0); keeps no reference to them.
  DiskMean(PlanePositions points, Vector weight, double radius);

  // Returns the mean of `values` (#P) around each point (#P); the value itself where nothing around it counts.
  Vector of(const Vector& values) const;

 private:
  std::pair<int, int> cell_of(Eigen::Index p) const;
  double mean_at(Eigen::Index p, const Vector& values) const;

  PlanePositions points_;
  Vector weight_;
  double radius_;
  std::map<std::pair<int, int>, std::vector<int>> cells_;
};

}  // namespace reflines
