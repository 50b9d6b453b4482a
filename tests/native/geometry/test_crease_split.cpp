// Each side of a crease has vertices of its own; a smooth surface stays as it is.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "geometry/crease.h"
#include "geometry/crease_split.h"
#include "geometry/normal_fit.h"
#include "reflines/errors.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr int kCells = 8;

// A grid folded along the middle, by this angle.
samples::Mesh fold(double angle) {
  return samples::lifted(samples::grid(kCells),
                         [angle](double x, double) { return std::max(0.0, x - 0.5) * std::tan(angle); });
}

TEST(CreaseSplit, AFoldIsSplitAllAlongAndNothingElse) {
  const samples::Mesh mesh = fold(0.8);
  const SplitSurface split = split_at_creases(mesh.V, mesh.F, kCreaseAngle);
  ASSERT_EQ(split.vertex.size(), mesh.V.rows() + kCells + 1);
  for (int v = 0; v < mesh.V.rows(); ++v) EXPECT_EQ(split.vertex[v], v);
  for (size_t s = mesh.V.rows(); s < split.vertex.size(); ++s) EXPECT_DOUBLE_EQ(mesh.V(split.vertex[s], 0), 0.5);
  for (int k = 0; k < mesh.F.size(); ++k) EXPECT_EQ(split.vertex[split.F.data()[k]], mesh.F.data()[k]);
}

TEST(CreaseSplit, NormalsOfEachSideAreItsOwnToTheEdge) {
  const samples::Mesh mesh = fold(0.8);
  const SplitSurface split = split_at_creases(mesh.V, mesh.F, kCreaseAngle);
  Positions V(split.vertex.size(), 3);
  for (int s = 0; s < V.rows(); ++s) V.row(s) = mesh.V.row(split.vertex[s]);
  const Positions N = NormalFit(V, split.F).normals(V);
  for (int t = 0; t < mesh.F.rows(); ++t) {
    const Vector3 a = mesh.V.row(mesh.F(t, 0)), b = mesh.V.row(mesh.F(t, 1)), c = mesh.V.row(mesh.F(t, 2));
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT((N.row(split.F(t, i)).transpose() - (b - a).cross(c - a).normalized()).norm(), 1e-12);
    }
  }
}

TEST(CreaseSplit, ASmoothSurfaceAndAGentleFoldStayWhole) {
  const samples::Mesh mesh = fold(0.3);
  const SplitSurface split = split_at_creases(mesh.V, mesh.F, kCreaseAngle);
  EXPECT_EQ(split.vertex.size(), mesh.V.rows());
  EXPECT_TRUE((split.F == mesh.F));
}

// Round a crease that ends inside the surface the triangles hang together: its end is one vertex.
TEST(CreaseSplit, ACreaseThatEndsInsideLeavesItsEndWhole) {
  samples::Mesh mesh = fold(0.8);
  for (int v = 0; v < mesh.V.rows(); ++v) mesh.V(v, 2) *= 1.0 - mesh.V(v, 1);
  const SplitSurface split = split_at_creases(mesh.V, mesh.F, kCreaseAngle);
  const std::set<int> doubled(split.vertex.begin() + mesh.V.rows(), split.vertex.end());
  EXPECT_EQ(doubled.size(), split.vertex.size() - mesh.V.rows());
  EXPECT_GT(doubled.size(), 2u);
  EXPECT_LT(doubled.size(), kCells - 2u);
  for (const int v : doubled) EXPECT_DOUBLE_EQ(mesh.V(v, 0), 0.5);
}

// A vertex on the straight side between two triangles of a plane, off it by rounding: the thin triangle's own normal
// may point anywhere.
TEST(CreaseSplit, AVertexOnAStraightSideIsNoCrease) {
  Positions V(5, 3);
  V << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -1, 0, 0.5, 0, 0;
  Triangles F(4, 3);
  F << 0, 1, 2, 0, 4, 1, 3, 4, 0, 3, 1, 4;
  for (const double off : {0.0, 1e-7, -1e-7}) {
    V.row(4) << 0.5, -1e-7, off;
    EXPECT_EQ(split_at_creases(V, F, kCreaseAngle).vertex.size(), 5u) << off;
  }
  V.row(3) << 0.5, -0.5, 1;  // a crease that runs through the thin triangle is one
  EXPECT_GT(split_at_creases(V, F, kCreaseAngle).vertex.size(), 5u);
}

TEST(CreaseSplit, RefusesIndicesOutOfRange) {
  const samples::Mesh mesh = samples::grid(2);
  Triangles F = mesh.F;
  F(0, 0) = 1000;
  EXPECT_THROW(split_at_creases(mesh.V, F, kCreaseAngle), InvalidInput);
}

}  // namespace
}  // namespace reflines
