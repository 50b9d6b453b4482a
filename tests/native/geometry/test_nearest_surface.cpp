#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "geometry/nearest_surface.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(NearestSurface, IsNearestOfAll) {
  const auto mesh =
      samples::lifted(samples::grid(12, 0.3), [](double x, double y) { return 0.3 * std::sin(9 * x * y); });
  std::vector<int> all(mesh.F.rows());
  std::iota(all.begin(), all.end(), 0);
  const NearestSurface surface(mesh.V, mesh.F, all);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.5, 1.5);
  for (int k = 0; k < 300; ++k) {
    const Vector3 p(place(random), place(random), place(random) - 0.5);
    double nearest = kInfinity;
    for (const int t : all) {
      const Vector3 q =
          nearest_in_triangle(p, mesh.V.row(mesh.F(t, 0)), mesh.V.row(mesh.F(t, 1)), mesh.V.row(mesh.F(t, 2)));
      nearest = std::min(nearest, (q - p).norm());
    }
    const NearestPoint found = surface.find(p, kInfinity);
    EXPECT_EQ(found.distance, nearest);
    EXPECT_NEAR((found.point - p).norm(), nearest, 1e-15);
    EXPECT_EQ(surface.find(p, 0.9 * nearest).triangle, -1);
  }
}

TEST(NearestSurface, OfATriangleItIsInsideOnAnEdgeOrACorner) {
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(nearest_in_triangle({0.2, 0.3, 2}, a, b, c), Vector3(0.2, 0.3, 0));
  EXPECT_EQ(nearest_in_triangle({0.5, -1, 1}, a, b, c), Vector3(0.5, 0, 0));
  EXPECT_EQ(nearest_in_triangle({-1, -1, 1}, a, b, c), a);
  EXPECT_EQ(nearest_in_triangle({3, 3, 0}, a, b, c), Vector3(0.5, 0.5, 0));
  EXPECT_EQ(nearest_in_triangle({0.5, 1, 0}, a, b, a), Vector3(0.5, 0, 0));  // without area
}

TEST(NearestSurface, NothingIsFoundInNoTriangle) {
  const samples::Mesh mesh = samples::grid(2);
  EXPECT_EQ(NearestSurface(mesh.V, mesh.F, {}).find(Vector3::Zero(), kInfinity).triangle, -1);
}

}  // namespace
}  // namespace reflines
