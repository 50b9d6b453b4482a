#include <gtest/gtest.h>

#include "geometry/cage_border.h"
#include "geometry/cage_symmetry.h"
#include "reflines/errors.h"
#include "tests/native/geometry/cages.h"

namespace reflines {
namespace {

const MirrorPlane kMiddle = {{3, 0, 0}, {-2, 0, 0}};  // of grid(6, n)

TEST(CageSymmetry, PartnersAreMutualAndLieInEachOthersImage) {
  const Positions V = grid(6, 4).V;
  const IndexVector partner = mirror_pairs(V, kMiddle, 1e-6);
  for (int v = 0; v < V.rows(); ++v) {
    ASSERT_GE(partner[v], 0);
    EXPECT_EQ(partner[partner[v]], v);
    EXPECT_EQ(V(v, 0) + V(partner[v], 0), 6);
    EXPECT_EQ(V(v, 1), V(partner[v], 1));
    EXPECT_EQ(partner[v] == v, V(v, 0) == 3);
  }
}

TEST(CageSymmetry, ObliquePlanesWork) {
  const Positions V = grid(5, 5).V;  // symmetric about its diagonal
  const IndexVector partner = mirror_pairs(V, {{0, 0, 0}, {1, -1, 0}}, 1e-6);
  for (int j = 0; j <= 5; ++j) {
    for (int i = 0; i <= 5; ++i) EXPECT_EQ(partner[6 * j + i], 6 * i + j);
  }
}

TEST(CageSymmetry, VerticesWithoutAnImageAreAlone) {
  Positions V = grid(6, 4).V;
  V(8, 2) += 0.1;  // vertex 12 is its partner
  const IndexVector partner = mirror_pairs(V, kMiddle, 1e-3);
  EXPECT_EQ((partner.array() < 0).count(), 2);
  EXPECT_EQ(partner[8], -1);
  EXPECT_EQ(partner[12], -1);
  EXPECT_EQ(mirror_pairs(V, kMiddle, 0.2)[8], 12);
}

TEST(CageSymmetry, DoubledVerticesOfAShutLineArePairedInOrder) {
  Positions V(5, 3);
  V << 1, 0, 0, 1, 0, 0, -1, 0, 0, -1, 0, 0, 0, 0, 0;
  const IndexVector expected = (IndexVector(5) << 2, 3, 0, 1, 4).finished();
  EXPECT_EQ(mirror_pairs(V, {{0, 0, 0}, {1, 0, 0}}, 1e-6), expected);
}

TEST(CageSymmetry, APlaneNeedsANormal) {
  EXPECT_THROW(mirror_pairs(grid(1, 1).V, {{0, 0, 0}, {0, 0, 0}}, 1e-6), InvalidInput);
}

TEST(CageSymmetry, UnknownsReachEveryFreeVertexOnceAndNoHeldOne) {
  const PlacedCage placed = grid(6, 6);
  const Subdivision surface = subdivide(placed.cage, {});
  const Mask held = find_held_vertices(surface, Mask::Constant(36, true), std::vector<Border>(49, Border::kClamped));
  const SparseMatrix B = build_cage_unknowns(held, mirror_pairs(placed.V, kMiddle, 1e-6));
  EXPECT_EQ(B.cols(), 3 * 2);  // 3 x 3 free vertices, a column of them on the plane
  const Vector reached = B * Vector::Ones(B.cols());
  for (int v = 0; v < reached.size(); ++v) EXPECT_EQ(reached[v], held[v] ? 0.0 : 1.0);
  EXPECT_EQ(build_cage_unknowns(held, {}).cols(), 9);
}

TEST(CageSymmetry, APartnerOfAHeldVertexIsHeld) {
  const PlacedCage placed = grid(6, 2);
  Mask held = Mask::Constant(21, false);
  held[0] = true;
  const SparseMatrix B = build_cage_unknowns(held, mirror_pairs(placed.V, kMiddle, 1e-6));
  EXPECT_EQ(B.cols(), 3 * 4 - 1);
  EXPECT_EQ((B * Vector::Ones(B.cols()))[6], 0.0);
}

// Symmetric unknowns give a symmetric surface, though not bit for bit: OpenSubdiv adds weights in its own order.
TEST(CageSymmetry, SymmetricCagesGiveSymmetricSurfaces) {
  PlacedCage placed = grid(6, 4);
  const SparseMatrix B = build_cage_unknowns(Mask::Constant(35, false), mirror_pairs(placed.V, kMiddle, 1e-6));
  placed.V.col(2) = B * Vector(Vector::LinSpaced(B.cols(), 0, 40).array().sin());
  const Subdivision surface = subdivide(placed.cage, {.level = 3});
  const Positions V = surface.positions * placed.V;
  const IndexVector partner = mirror_pairs(V, kMiddle, 1e-9);
  ASSERT_GE(partner.minCoeff(), 0);
  for (int v = 0; v < V.rows(); ++v) EXPECT_NEAR(V(v, 2), V(partner[v], 2), 1e-14);
}

}  // namespace
}  // namespace reflines
