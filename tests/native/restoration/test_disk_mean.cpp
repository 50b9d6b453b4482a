#include <gtest/gtest.h>

#include <random>

#include "restoration/disk_mean.h"

namespace reflines {
namespace {

// The mean as it is defined, over all points.
double mean_of_all(const PlanePositions& points, const Vector& weight, double radius, const Vector& values, int at) {
  const Vector distance = (points.rowwise() - points.row(at)).rowwise().norm() / radius;
  const Vector kernel = weight.array() * (1.0 - distance.array().square()).max(0.0);
  return kernel.sum() > 0 ? kernel.dot(values) / kernel.sum() : values(at);
}

// Points in clusters, so that cells have many, one and none; some that do not count; some far from all others.
TEST(DiskMean, IsThatOverAllPoints) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr int kCount = 400;
  PlanePositions points(kCount, 2);
  Vector weight(kCount), values(kCount);
  for (int p = 0; p < kCount; ++p) {
    points.row(p) << 3 * (p % 5) + normal(random), (p < 5 ? 100.0 * p : 0.0) + normal(random);
    weight(p) = p % 7 == 0 ? 0.0 : 1.0 + p % 3;
    values(p) = normal(random);
  }
  for (const double radius : {1e-6, 0.3, 1.0, 7.0, 1e4}) {
    const Vector mean = DiskMean(points, weight, radius).of(values);
    for (int p = 0; p < kCount; ++p)
      EXPECT_NEAR(mean(p), mean_of_all(points, weight, radius, values, p), 1e-13) << radius << ", " << p;
  }
}

// Dense points are merged: means of a smooth function and of noise stay those over all points, but for 0.003 and 0.008
// of the spread of their values.
TEST(DiskMean, StaysThatOfDensePointsWhereTheyAreMerged) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(0.0, 3.0);
  std::normal_distribution<double> normal;
  constexpr int kCount = 9000;
  PlanePositions points(kCount, 2);
  Eigen::MatrixXd values(kCount, 2);
  Vector weight(kCount);
  for (int p = 0; p < kCount; ++p) {
    points.row(p) << place(random), place(random);
    weight(p) = 1.0 + p % 3;
    values.row(p) << std::sin(2 * points(p, 0) + points(p, 1)), normal(random);
  }
  const Eigen::MatrixXd mean = DiskMean(points, weight, 1.0).of_columns(values);
  double worst[2] = {0.0, 0.0};
  for (int p = 0; p < kCount; p += 7) {
    for (int k = 0; k < 2; ++k)
      worst[k] = std::max(worst[k], std::abs(mean(p, k) - mean_of_all(points, weight, 1.0, values.col(k), p)));
  }
  EXPECT_LT(worst[0], 0.005);
  EXPECT_LT(worst[1], 0.012);
  EXPECT_GT(worst[1], 1e-9) << "nothing was merged";
}

}  // namespace
}  // namespace reflines
