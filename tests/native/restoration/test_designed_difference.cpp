// What halves differ by is design where it is steep and above the noise, and then as a whole.
#include <gtest/gtest.h>

#include <cmath>

#include "restoration/designed_difference.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr double kLength = 0.1, kDeepest = 0.02;

struct Difference {
  samples::Mesh mesh;
  PlanePositions xy;
  Vector height;
};

Difference make_difference(const samples::Height& height) {
  const samples::Mesh mesh = samples::lifted(samples::grid(50, 0.1), height);
  return {mesh, mesh.V.leftCols(2), mesh.V.col(2)};
}

Mask find(const Difference& difference, double roughness = 0.0, double deepest = kDeepest) {
  const Vector rough = Vector::Constant(difference.height.size(), roughness);
  return find_designed_differences(difference.xy, difference.mesh.F, difference.height, rough, deepest, kLength);
}

double distance(double x, double y) { return std::hypot(x - 0.6, y - 0.5); }

// A recess with a floor, 0.2 wide, whose rim falls by 0.004 within 0.06.
double recess(double x, double y) { return -0.002 * (1 - std::tanh((distance(x, y) - 0.1) / 0.015)); }

// A dent with slopes of up to 0.01.
double dent(double x, double y) { return -0.0006 * std::exp(-std::pow(distance(x, y) / 0.05, 2)); }

TEST(DesignedDifference, IsTheWholeOfARecess) {
  const Difference difference = make_difference(recess);
  const Mask design = find(difference);
  for (Eigen::Index v = 0; v < design.size(); ++v) {
    const double from_center = distance(difference.xy(v, 0), difference.xy(v, 1));
    if (from_center < 0.11) {
      EXPECT_TRUE(design(v)) << v;
    } else if (from_center > 0.2) {
      EXPECT_FALSE(design(v)) << v;
    }
  }
}

TEST(DesignedDifference, IsNoDent) { EXPECT_FALSE(find(make_difference(dent)).any()); }

TEST(DesignedDifference, IsADentThatIsTooDeep) { EXPECT_TRUE(find(make_difference(dent), 0.0, 0.0005).any()); }

TEST(DesignedDifference, IsNotWhatIsLowerThanItIsRough) { EXPECT_FALSE(find(make_difference(recess), 0.005).any()); }

TEST(DesignedDifference, IsNoRippleOfTheWholeRegion) {
  const auto ripple = [](double x, double y) { return 0.001 * std::sin(40 * x) * std::sin(40 * y); };
  EXPECT_FALSE(find(make_difference(ripple)).any());
}

}  // namespace
}  // namespace reflines
