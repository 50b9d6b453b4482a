// The coarse motions: B-splines that add up to one where nothing is held, and leave alone what is.
#include <gtest/gtest.h>

#include "native/geometry/smooth_modes.h"

namespace reflines {
namespace {

constexpr int kSide = 40;  // cells

HeightField flat_square(Border border) {
  Positions V((kSide + 1) * (kSide + 1), 3);
  Triangles F(2 * kSide * kSide, 3);
  for (int j = 0; j <= kSide; ++j) {
    for (int i = 0; i <= kSide; ++i) V.row(j * (kSide + 1) + i) << i, j, 0.0;
  }
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const int a = j * (kSide + 1) + i, b = a + kSide + 1;
      F.row(2 * (j * kSide + i)) << a, a + 1, b + 1;
      F.row(2 * (j * kSide + i) + 1) << a, b + 1, b;
    }
  }
  Boundary boundary;
  boundary.border.assign(V.rows(), border);
  return make_height_field(V, F, ImagePlane(Vector3::UnitZ(), Vector3::UnitY()), boundary);
}

TEST(SmoothModesTest, AddUpToOneWhereNothingIsHeld) {
  const HeightField field = flat_square(Border::kClamped);
  const SparseMatrix modes = smooth_modes(field, 4.0);
  const Vector sums = modes.transpose() * Vector::Ones(modes.rows());
  ASSERT_EQ(modes.cols(), (kSide - 3) * (kSide - 3));
  EXPECT_GT(modes.rows(), 9);
  EXPECT_GE(sums.minCoeff(), 0.0);
  EXPECT_LE(sums.maxCoeff(), 1.0 + 1e-12);
  EXPECT_NEAR(sums(modes.cols() / 2), 1.0, 1e-12);
  EXPECT_LT(sums(0), 1e-3);  // beside two clamped borders: position and tangent are theirs
}

TEST(SmoothModesTest, AFreeBorderMovesToo) {
  const HeightField field = flat_square(Border::kFree);
  const SparseMatrix modes = smooth_modes(field, 4.0);
  const Vector sums = modes.transpose() * Vector::Ones(modes.rows());
  EXPECT_EQ(modes.cols(), (kSide + 1) * (kSide + 1));
  EXPECT_GT(sums.minCoeff(), 0.5);
}

TEST(SmoothModesTest, ASmallRegionHasNone) { EXPECT_EQ(smooth_modes(flat_square(Border::kClamped), 20.0).rows(), 0); }

}  // namespace
}  // namespace reflines
