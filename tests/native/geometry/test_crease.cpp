#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "geometry/mesh.h"
#include "geometry/piece.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

int crease_count(const samples::Mesh& mesh, double angle = kCreaseAngle) {
  return static_cast<int>(crease_edges(mesh.V, mesh.F, edge_neighbors(mesh.F), {.angle = angle}).count()) / 2;
}

// A gentle bowl with a V-shaped groove of the given depth along x = 0.5, one cell to each side.
samples::Mesh grooved(double depth) {
  return samples::lifted(samples::grid(32), [=](double x, double y) {
    return 0.05 * (x * x + y * y) - (std::abs(x - 0.5) < 1e-9 ? depth : 0.0);
  });
}

TEST(Crease, AGentlePanelHasNone) {
  EXPECT_EQ(crease_count(grooved(0.0)), 0);
  EXPECT_EQ(crease_count(samples::grid(8)), 0);  // flat: the median edge is zero
}

TEST(Crease, ALongGrooveIsOneThoughNoEdgeIsSharp) {
  // Depth 0.006 over a cell of 1 / 32: the sides tilt by 11 degrees, the bottom bends by 22.
  EXPECT_GT(crease_count(grooved(0.006)), 32);
}

// The bowl with 64 cells a side and a groove along x = 0.5 that ends inside, whose bottom has `length` vertices. The
// edges that it bends reach over length + 1 cells.
samples::Mesh short_groove(int length) {
  samples::Mesh mesh = samples::lifted(samples::grid(64), [](double x, double y) { return 0.05 * (x * x + y * y); });
  for (int j = 28; j < 28 + length; ++j) mesh.V(j * 65 + 32, 2) -= 0.003;
  return mesh;
}

// The region reaches over the diagonal of its square, 90 cells, of which 8 % are 7.2.
TEST(Crease, AChainReachesOverEightPercentOfTheRegionHoweverItIsTurned) {
  for (int k = 0; k < 20; ++k) {
    const Eigen::AngleAxisd turn(0.7 * k, Vector3(1, k % 4, k % 3).normalized());
    for (const int length : {4, 5, 8, 12}) {
      samples::Mesh mesh = short_groove(length);
      for (int v = 0; v < mesh.V.rows(); ++v) mesh.V.row(v) = (turn * mesh.V.row(v).transpose()).transpose();
      EXPECT_EQ(crease_count(mesh) > 0, length + 1 > 7.2) << length << " vertices, turned by " << turn.angle();
    }
  }
}

TEST(Crease, AVertexOutOfPlaceIsNoCrease) {
  samples::Mesh mesh = grooved(0.0);
  mesh.V(16 * 33 + 16, 2) += 0.006;  // bends its edges as the groove does
  EXPECT_EQ(crease_count(mesh), 0);
}

TEST(Crease, EdgesSharperThanTheAngleAlwaysAre) {
  samples::Mesh mesh = grooved(0.0);
  mesh.V(16 * 33 + 16, 2) += 0.05;
  EXPECT_GT(crease_count(mesh), 0);
  EXPECT_EQ(crease_count(mesh, std::numbers::pi), 0);
}

TEST(Crease, NeighboursStayInOnePieceThoughAllTheirVerticesAreHeld) {
  samples::Mesh mesh = grooved(0.006);
  for (int j = 8; j <= 24; j += 8) mesh.V(j * 33 + 15, 2) += 0.02;  // creases of all kinds, touching one another
  const HeightField field = samples::height_field(mesh);
  size_t triangles = 0;
  for (const Piece& piece : split_pieces(field)) {
    triangles += piece.field.source.size();
    EXPECT_LT(piece.field.neighbors.maxCoeff(), piece.field.triangle_count());
  }
  EXPECT_EQ(static_cast<int>(triangles), field.triangle_count());
}

}  // namespace
}  // namespace reflines
