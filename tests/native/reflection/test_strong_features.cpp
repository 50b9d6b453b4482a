#include <gtest/gtest.h>

#include "reflection/strong_features.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

// 16 x 16 cells, cut in two; in the first `kStrip` cells of the ninth row the lines bend by `strip`, elsewhere by
// `rest`.
constexpr int kCells = 16, kStrip = 7;

int count_features(double rest, double strip, double length) {
  const HeightField field = samples::height_field(samples::grid(kCells));
  PlaneVectors gradient = PlaneVectors::Zero(field.triangle_count(), 2);
  gradient.col(0).setConstant(rest);
  gradient.middleRows(2 * kCells * 8, 2 * kStrip).rowwise() = strip * Eigen::RowVector2d(0.6, -0.8);
  const Mask features = strong_features(field, gradient, length);
  EXPECT_EQ(features.segment(2 * kCells * 8, 2 * kStrip).count(), features.count());
  return static_cast<int>(features.count());
}

const double kExtent = std::hypot(kStrip, 1) / kCells;  // the diagonal of the strip

TEST(StrongFeatures, ReachFartherThanTheLength) {
  EXPECT_EQ(count_features(2.0, 100.0, kExtent / 1.5), 2 * kStrip);
  EXPECT_EQ(count_features(2.0, 100.0, kExtent / 1.1), 2 * kStrip);
  EXPECT_EQ(count_features(2.0, 100.0, kExtent / 0.9), 0);
  EXPECT_EQ(count_features(2.0, 100.0, kExtent / 0.75), 0);
}

TEST(StrongFeatures, BendByEightTimesTheMedian) {
  for (const double median : {2.0, 50.0}) {
    EXPECT_EQ(count_features(median, 1.1 * 8 * median, 0.2), 2 * kStrip);
    EXPECT_EQ(count_features(median, 0.9 * 8 * median, 0.2), 0);
    EXPECT_EQ(count_features(median, 0.75 * 8 * median, 0.2), 0);
  }
}

TEST(StrongFeatures, OnAFlatPanelBendByTenOverItsDiagonal) {
  const double least = 10 / std::sqrt(2.0);
  for (const double median : {0.0, least / 80}) {
    EXPECT_EQ(count_features(median, 1.1 * least, 0.2), 2 * kStrip);
    EXPECT_EQ(count_features(median, 0.9 * least, 0.2), 0);
    EXPECT_EQ(count_features(median, 0.75 * least, 0.2), 0);
  }
}

}  // namespace
}  // namespace reflines
