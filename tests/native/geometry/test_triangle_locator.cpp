#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geometry/triangle_locator.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

// Every triangle tried, the smallest number first.
int by_trying(const PlanePositions& xy, const Triangles& F, const Vector2& point) {
  for (int t = 0; t < F.rows(); ++t) {
    const Vector2 a = xy.row(F(t, 0)), ab = xy.row(F(t, 1)).transpose() - a, ac = xy.row(F(t, 2)).transpose() - a;
    const Vector2 ap = point - a;
    const double area = ab.x() * ac.y() - ab.y() * ac.x();
    const double v = (ap.x() * ac.y() - ap.y() * ac.x()) / area, w = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
    if (std::min({1 - v - w, v, w}) >= -1e-12) return t;
  }
  return -1;
}

TEST(TriangleLocator, FindsWhatTryingAllFinds) {
  const samples::Mesh mesh = samples::grid(9, 0.35);
  const PlanePositions xy = mesh.V.leftCols<2>();
  const TriangleLocator locator(xy, mesh.F);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.1, 1.1);
  for (int k = 0; k < 4000; ++k) {
    const Vector2 point(place(random), place(random));
    EXPECT_EQ(locator.locate(point).triangle, by_trying(xy, mesh.F, point)) << point.transpose();
  }
  for (int v = 0; v < xy.rows(); ++v) {
    EXPECT_EQ(locator.locate(xy.row(v)).triangle, by_trying(xy, mesh.F, xy.row(v)));
  }
}

// Sheared until each triangle crosses many bins.
TEST(TriangleLocator, FindsThemInSliversToo) {
  samples::Mesh mesh = samples::grid(40, 0.2);
  PlanePositions xy = mesh.V.leftCols<2>();
  xy.col(1) = 1e-3 * xy.col(1) + xy.col(0);
  const TriangleLocator locator(xy, mesh.F);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(0, 1);
  int inside = 0;
  for (int k = 0; k < 2000; ++k) {
    const double x = place(random);
    const Vector2 point(x, x + 1e-3 * place(random));
    EXPECT_EQ(locator.locate(point).triangle, by_trying(xy, mesh.F, point));
    inside += locator.locate(point).triangle >= 0;
  }
  EXPECT_GT(inside, 1800);
}

TEST(TriangleLocator, WhatIsNoPointLiesOutside) {
  const samples::Mesh mesh = samples::grid(4);
  const PlanePositions xy = mesh.V.leftCols<2>();
  const TriangleLocator locator(xy, mesh.F);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double x : {std::nan(""), infinite, -infinite, 1e300, -1e300}) {
    EXPECT_EQ(locator.locate({x, 0.5}).triangle, -1);
    EXPECT_EQ(locator.locate({0.5, x}).triangle, -1);
  }
}

}  // namespace
}  // namespace reflines
