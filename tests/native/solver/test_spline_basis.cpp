// The coarse motions: B-splines that add up to one where nothing is held, and leave alone what is.
#include <gtest/gtest.h>

#include "solver/coarse/spline_basis.h"

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

// What each free vertex moves by when every mode has strength one.
Vector moved_together(const SplineBasis& modes) {
  Vector x = Vector::Zero(modes.places.rows());
  modes.move(Vector::Ones(modes.count), x);
  return x;
}

TEST(SmoothModesTest, AddUpToOneWhereNothingIsHeld) {
  const HeightField field = flat_square(Border::kClamped);
  const SplineBasis modes = build_spline_basis(field, 4.0);
  const Vector sums = moved_together(modes);
  ASSERT_EQ(sums.size(), (kSide - 3) * (kSide - 3));
  EXPECT_GT(modes.count, 9);
  EXPECT_GE(sums.minCoeff(), 0.0);
  EXPECT_LE(sums.maxCoeff(), 1.0 + 1e-12);
  EXPECT_NEAR(sums(sums.size() / 2), 1.0, 1e-12);
  EXPECT_LT(sums(0), 1e-3);  // beside two clamped borders: position and tangent are theirs
}

TEST(SmoothModesTest, AFreeBorderMovesToo) {
  const HeightField field = flat_square(Border::kFree);
  const Vector sums = moved_together(build_spline_basis(field, 4.0));
  EXPECT_EQ(sums.size(), (kSide + 1) * (kSide + 1));
  EXPECT_GT(sums.minCoeff(), 0.5);
}

// The two halves of a body across the corners of its box: a grid over that box had thousands of times their splines.
TEST(SmoothModesTest, ThereAreNoneForHalvesFarApart) {
  const HeightField near = flat_square(Border::kFree);
  HeightField far = near;
  far.xy.bottomRows(far.xy.rows() / 2).array() += 1e5;
  EXPECT_GT(build_spline_basis(near, 4.0).count, 0);
  EXPECT_EQ(build_spline_basis(far, 4.0).count, 0);
  far.xy.bottomRows(far.xy.rows() / 2).array() += 1e12;  // more cells than an int counts
  EXPECT_EQ(build_spline_basis(far, 4.0).count, 0);
}

// P^T g . c = g . P c.
TEST(SmoothModesTest, PullingBackIsTheTransposeOfMoving) {
  const SplineBasis modes = build_spline_basis(flat_square(Border::kFree), 4.0);
  const Vector c = Vector::LinSpaced(modes.count, -1.0, 2.0);
  const Vector g = Vector::LinSpaced(modes.places.rows(), 3.0, -1.0);
  Vector x = Vector::Zero(g.size());
  modes.move(c, x);
  EXPECT_NEAR(modes.pull_back(g).dot(c), g.dot(x), 1e-10);
}

TEST(SmoothModesTest, ASmallRegionHasNone) {
  EXPECT_EQ(build_spline_basis(flat_square(Border::kClamped), 20.0).count, 0);
}

// The samples are a quadrature: together they stand for the area of all cells that hold a motion, each once.
TEST(SmoothModesTest, SamplesStandForTheWholeArea) {
  const HeightField field = flat_square(Border::kFree);
  const SplineBasis modes = build_spline_basis(field, 4.0);
  double area = 0;
  for (const SplineSample& sample : modes.samples) area += sample.area_ratio * field.area(sample.triangle);
  EXPECT_NEAR(area, kSide * kSide, 1e-9);
  EXPECT_LT(modes.samples.size(), field.triangle_count() / 2);
}

TEST(SmoothModesTest, DerivativesAreThoseOfTheSplines) {
  const double step = 0.5, h = 1e-4;
  const Vector2 place(0.3, 0.8);
  const SplineDerivatives here = spline_derivatives(place, step);
  for (int axis = 0; axis < 2; ++axis) {
    const Vector2 aside = Vector2::Unit(axis) * h / step;
    const SplineDerivatives change = spline_derivatives(place + aside, step) - spline_derivatives(place - aside, step);
    EXPECT_LT((change.row(0) / (2 * h) - here.row(1 + axis)).norm(), 1e-6);
    EXPECT_LT((change.row(1) / (2 * h) - here.row(3 + axis)).norm(), 1e-5);
    EXPECT_LT((change.row(2) / (2 * h) - here.row(4 + axis)).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace reflines
