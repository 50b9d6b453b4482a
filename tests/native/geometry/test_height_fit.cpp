#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "geometry/height_fit.h"

namespace reflines {
namespace {

double cubic(double x, double y) {
  return 0.3 + 0.2 * x - 0.4 * y + 1.5 * x * x - 0.7 * x * y + 0.25 * y * y + 2 * x * x * y - y * y * y;
}

// Points beside the origin, y >= 0, on `rows` straight rows or anywhere.
PlanePositions points_beside(int rows) {
  PlanePositions points(40, 2);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int k = 0; k < points.rows(); ++k)
    points.row(k) << place(random), rows > 0 ? static_cast<double>(k % rows) / rows : std::abs(place(random));
  return points;
}

HeightFit fit_cubic(const PlanePositions& points, double scale) {
  Vector heights(points.rows());
  for (int k = 0; k < points.rows(); ++k) heights(k) = cubic(points(k, 0), points(k, 1));
  return fit_heights(scale * points, heights);
}

TEST(HeightFit, ReproducesACubicFromOneSideInAnyUnit) {
  for (const double scale : {1.0, 1000.0, 1e-3}) {
    const HeightFit fit = fit_cubic(points_beside(0), scale);
    EXPECT_EQ(fit.degree, 3);
    EXPECT_NEAR(fit.height, 0.3, 1e-12);
    EXPECT_LT((scale * fit.slope - Vector2(0.2, -0.4)).norm(), 1e-11);
    EXPECT_LT((scale * scale * fit.second - Vector3(3, -0.7, 0.5)).norm(), 1e-10);
    EXPECT_LT((scale * scale * scale * fit.third - Vector4(0, 4, 0, -6)).norm(), 1e-9);
    EXPECT_LT(scale * scale * fit.second_error, 1e-10);
    EXPECT_LT(scale * scale * scale * fit.third_error, 1e-9);
  }
}

TEST(HeightFit, TheStandardErrorsAreThoseOfManyNoisyHeights) {
  const PlanePositions points = points_beside(0);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.01);
  Vector2 squared = Vector2::Zero(), expected = Vector2::Zero();
  for (int trial = 0; trial < 2000; ++trial) {
    Vector heights(points.rows());
    for (int k = 0; k < points.rows(); ++k) heights(k) = cubic(points(k, 0), points(k, 1)) + noise(random);
    const HeightFit fit = fit_heights(points, heights);
    squared += Vector2((fit.second - Vector3(3, -0.7, 0.5)).cwiseAbs2().dot(Vector3(1, 2, 1)),
                       (fit.third - Vector4(0, 4, 0, -6)).cwiseAbs2().dot(Vector4(1, 3, 3, 1)));
    expected += Vector2(fit.second_error, fit.third_error).cwiseAbs2();
  }
  EXPECT_NEAR(expected(0) / squared(0), 1, 0.1);
  EXPECT_NEAR(expected(1) / squared(1), 1, 0.1);
}

TEST(HeightFit, WithoutAResidualTheErrorIsUnknown) {
  EXPECT_EQ(fit_cubic(points_beside(0).topRows(10), 1).third_error, std::numeric_limits<double>::infinity());
  EXPECT_EQ(fit_cubic(points_beside(0).topRows(6), 1).second_error, std::numeric_limits<double>::infinity());
}

TEST(HeightFit, RowsThatLeaveACubicOpenGiveAQuadratic) {
  EXPECT_EQ(fit_cubic(points_beside(4), 1).degree, 3);
  EXPECT_EQ(fit_cubic(points_beside(3), 1).degree, 2);
  EXPECT_EQ(fit_cubic(points_beside(2), 1).degree, 0);
  EXPECT_EQ(fit_cubic(points_beside(0).topRows(5), 1).degree, 0);
}

}  // namespace
}  // namespace reflines
