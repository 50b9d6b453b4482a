#include "restoration/disk_mean.h"

#include "restoration/grid_cell.h"

namespace reflines {

DiskMean::DiskMean(PlanePositions points, Vector weight, double radius)
    : points_(std::move(points)), weight_(std::move(weight)), radius_(radius) {
  for (Eigen::Index p = 0; p < points_.rows(); ++p) cells_[cell_of(p)].push_back(static_cast<int>(p));
}

std::pair<int, int> DiskMean::cell_of(Eigen::Index p) const { return find_grid_cell(points_.row(p), radius_); }

double DiskMean::mean_at(Eigen::Index p, const Vector& values) const {
  double sum = 0, weights = 0;
  const auto [i, j] = cell_of(p);
  for (int d = 0; d < 9; ++d) {
    const auto cell = cells_.find({i + d / 3 - 1, j + d % 3 - 1});
    if (cell == cells_.end()) continue;
    for (const int other : cell->second) {
      const double distance = (points_.row(other) - points_.row(p)).squaredNorm() / (radius_ * radius_);
      if (distance >= 1) continue;
      const double weight = weight_(other) * (1 - distance);
      sum += weight * values(other);
      weights += weight;
    }
  }
  return weights > 0 ? sum / weights : values(p);
}

Vector DiskMean::of(const Vector& values) const {
  Vector result(values.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (Eigen::Index p = 0; p < values.size(); ++p) result(p) = mean_at(p, values);
  return result;
}

}  // namespace reflines
