// Dents planted in smooth surfaces are taken out, also those that overlap, and smooth surfaces stay.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/height_field.h"
#include "restoration/bump_removal.h"
#include "restoration/curvature_variation.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr double kLength = 0.2, kRadius = 0.08;

struct Dent {
  Vector2 center;
  double height;

  double at(const Vector2& p) const { return height * std::exp(-(p - center).squaredNorm() / (kRadius * kRadius)); }
};

double clean_height(const Vector2& p) { return -0.15 * p.x() * p.x() - 0.1 * p.y() * p.y() + 0.02 * p.x() * p.y(); }

samples::Mesh make_panel(const std::vector<Dent>& dents) {
  return samples::lifted(samples::grid(60, 0.1), [&](double x, double y) {
    double z = clean_height({x, y});
    for (const Dent& dent : dents) z += dent.at({x, y});
    return z;
  });
}

struct Found {
  int count;
  double left, planted;  // root mean squares of the heights' distance from the clean ones
};

Found remove_from(const std::vector<Dent>& dents) {
  const samples::Mesh panel = make_panel(dents), clean = make_panel({});
  const HeightField field = samples::height_field(panel, Border::kFree);
  const CurvatureVariation variation(field);
  const BumpRemoval removal = remove_bumps(
      variation, MeanPlane(field), field.z, kLength, [](const Vector& z) { return z; }, nullptr);
  const Vector planted = panel.V.col(2) - clean.V.col(2);
  return {removal.count, (planted + removal.heights - field.z).norm(), planted.norm()};
}

TEST(BumpRemoval, LeavesASmoothSurfaceAlone) {
  const Found found = remove_from({});
  EXPECT_EQ(found.count, 0);
  EXPECT_EQ(found.left, 0.0);
}

TEST(BumpRemoval, TakesADentOut) {
  const Found found = remove_from({{{0.6, 0.45}, -0.001}});
  EXPECT_GE(found.count, 1);
  EXPECT_LT(found.left, 0.2 * found.planted);
}

// The second of two dents that overlap is seen when the first is gone, and a third far from both at once.
TEST(BumpRemoval, TakesDentsOutThatOverlap) {
  const Found found = remove_from({{{0.6, 0.45}, -0.001}, {{0.7, 0.47}, 0.0007}, {{0.25, 0.7}, -0.0008}});
  EXPECT_GE(found.count, 3);
  EXPECT_LT(found.left, 0.3 * found.planted);
}

// A knob as round as a dent: no bump explains more than all of a surface, which it would have to.
TEST(BumpRemoval, LeavesASteepBumpAndItsPartsAlone) {
  const Found found = remove_from({{{0.6, 0.45}, 0.02}});
  EXPECT_EQ(found.count, 0);
  EXPECT_EQ(found.left, found.planted);
}

}  // namespace
}  // namespace reflines
