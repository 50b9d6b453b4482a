#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "geometry/derivatives.h"
#include "geometry/mesh.h"
#include "geometry/piece.h"
#include "reflines/errors.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

std::string refusal(const Positions& V, const Triangles& F) {
  try {
    check_surface(V, F);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(Mesh, EveryInnerEdgeOfAGridHasTwoTriangles) {
  const samples::Mesh mesh = samples::grid(4);
  const Triangles neighbors = edge_neighbors(mesh.F);
  EXPECT_EQ((neighbors.array() < 0).count(), 4 * 4);  // the square's border edges, no more
  for (int t = 0; t < mesh.F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) < 0) continue;
      EXPECT_TRUE((neighbors.row(neighbors(t, i)).array() == t).any());
    }
  }
}

TEST(Mesh, EdgeOfThreeTrianglesHasNoNeighborsInAnyOrder) {
  Triangles fin(3, 3);
  fin << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  for (int round = 0; round < 3; ++round) {
    EXPECT_TRUE((edge_neighbors(fin).array() == -1).all());
    fin = Triangles(fin({1, 2, 0}, Eigen::all));
  }
}

TEST(Mesh, RefusesWhatIsNoSurface) {
  const samples::Mesh mesh = samples::grid(2);
  EXPECT_EQ(refusal(mesh.V, mesh.F), "");
  EXPECT_NE(refusal(mesh.V, Triangles(0, 3)).find("no face"), std::string::npos);
  Triangles F = mesh.F;
  F(0, 0) = 99;
  EXPECT_NE(refusal(mesh.V, F).find("99"), std::string::npos);
  F = mesh.F;
  F.row(1) = F.row(0).reverse();
  EXPECT_NE(refusal(mesh.V, F).find("doubled"), std::string::npos);
  Positions V = mesh.V;
  V(4, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(V, mesh.F).find("not a finite number"), std::string::npos);
  V = mesh.V;
  V.row(1) = V.row(0);
  EXPECT_NE(refusal(V, mesh.F).find("zero area"), std::string::npos);
}

TEST(Mesh, RefusesAThirdFaceOnAnEdge) {
  Positions V(5, 3);
  V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1;
  Triangles F(3, 3);
  F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  EXPECT_NE(refusal(V, F).find("1 edge of the region has more than two faces"), std::string::npos);
}

TEST(Mesh, WithoutItsUnusableTrianglesIsASurface) {
  samples::Mesh mesh = samples::grid(6, 0.2);
  const auto tidy = static_cast<int>(mesh.F.rows());
  const auto own = static_cast<int>(mesh.V.rows());
  EXPECT_FALSE(find_unusable(mesh.V, mesh.F).any());
  mesh.V.conservativeResize(own + 2, 3);
  mesh.V.bottomRows(2) << 0.5, 0.5, 0.5, NAN, 0, 0;
  mesh.F.conservativeResize(tidy + 4, 3);
  mesh.F.row(tidy) = mesh.F.row(0);                                     // a copy
  mesh.F.row(tidy + 1) << mesh.F(30, 0), mesh.F(30, 1), own;            // a third at an inner edge
  mesh.F.row(tidy + 2) << mesh.F(50, 0), mesh.F(50, 1), own + 1;        // not finite
  mesh.F.row(tidy + 3) << mesh.F(10, 0), mesh.F(10, 0), mesh.F(10, 1);  // without area
  EXPECT_THROW(check_surface(mesh.V, mesh.F), InvalidInput);
  const Mask unusable = find_unusable(mesh.V, mesh.F);
  EXPECT_TRUE(unusable.tail(4).all());
  EXPECT_TRUE(unusable(0) && unusable(30));
  EXPECT_FALSE(unusable(50) || unusable(10));
  std::vector<int> kept;
  for (int t = 0; t < unusable.size(); ++t) {
    if (!unusable(t)) kept.push_back(t);
  }
  EXPECT_GE(static_cast<int>(kept.size()), tidy - 5);  // the first has two inner edges, the 30th one
  EXPECT_NO_THROW(check_surface(mesh.V, mesh.F(kept, Eigen::all)));
}

TEST(HeightField, ClampedHoldsTwoLayersAndFixedOne) {
  const samples::Mesh mesh = samples::grid(6);
  const auto free_count = [&](Border border) {
    const HeightField field = samples::height_field(mesh, border);
    return std::count(field.role.begin(), field.role.end(), VertexRole::kFree);
  };
  EXPECT_EQ(free_count(Border::kFree), 7 * 7);
  EXPECT_EQ(free_count(Border::kFixed), 5 * 5);
  EXPECT_EQ(free_count(Border::kClamped), 3 * 3);
}

TEST(HeightField, FoldedTrianglesAreLeftOutAndTheirVerticesHeld) {
  samples::Mesh mesh = samples::grid(8);
  const int middle = 4 * 9 + 4;
  mesh.V.row(middle) << 0.5 + 1.5 / 8, 0.5, 0.0;  // pulled across its neighbour: two triangles turn over
  const HeightField field = samples::height_field(mesh);
  EXPECT_GT(field.turned_away.count(), 0);
  EXPECT_EQ(field.triangle_count() + field.turned_away.count() + field.silhouette.count(), mesh.F.rows());
  EXPECT_EQ(field.role[middle], VertexRole::kFixed);
  EXPECT_GT(field.area.minCoeff(), 0);
}

TEST(HeightField, ASphereSeenFromOutsideIsOnePieceOfItsFrontHalf) {
  // A closed octahedron, twice split and blown up to a sphere.
  Positions V(6, 3);
  V << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  Triangles F(8, 3);
  F << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
  Boundary boundary;
  boundary.border.assign(6, Border::kFixed);
  boundary.creases.angle = std::numbers::pi;  // so coarse a sphere is all creases
  const HeightField field = make_height_field(V, F, ImagePlane(Vector3(0, 0, 1), Vector3(0, 1, 0)), boundary);
  EXPECT_TRUE(field.closed);
  EXPECT_EQ(field.piece_count, 1);
  EXPECT_EQ(field.triangle_count(), 4);
  EXPECT_EQ(field.turned_away.count(), 4);
  EXPECT_EQ(field.role[4], VertexRole::kFree);  // the pole; the equator is on triangles that turn away
  EXPECT_EQ(field.role[0], VertexRole::kFixed);
}

TEST(HeightField, ACreaseIsHeldAndNoStencilReachesAcross) {
  const samples::Mesh roof = samples::lifted(samples::grid(8), [](double x, double) { return -std::abs(x - 0.5); });
  const HeightField field = samples::height_field(roof, Border::kFree);
  EXPECT_EQ(field.crease_count, 8);  // the ridge bends by 90 degrees
  EXPECT_EQ(field.piece_count, 2);
  EXPECT_EQ(field.role[4 * 9 + 4], VertexRole::kFixed);
  for (const Piece& piece : split_pieces(field)) {
    const Stencils stencils = make_stencils(piece.field, StencilKind::kConsistent);
    TriangleDerivatives u;
    apply_stencils(stencils, piece.field.z, u);
    EXPECT_LT(u.rightCols<3>().cwiseAbs().maxCoeff(), 1e-9);  // each side is a plane
  }
}

TEST(Pieces, EveryTriangleIsInOnePieceWithItsOwnNumbers) {
  const samples::Mesh mesh = samples::grid(4);
  Triangles F(mesh.F.rows() - 8, 3);  // without the second row of cells: two strips
  F << mesh.F.topRows(8), mesh.F.bottomRows(mesh.F.rows() - 16);
  Boundary boundary;
  boundary.border.assign(mesh.V.rows(), Border::kFixed);
  const HeightField field = make_height_field(mesh.V, F, ImagePlane(Vector3::UnitZ(), Vector3::UnitY()), boundary);
  const std::vector<Piece> pieces = split_pieces(field);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].field.triangle_count() + pieces[1].field.triangle_count(), F.rows());
  for (const Piece& piece : pieces) {
    for (int t = 0; t < piece.field.triangle_count(); ++t) {
      for (int i = 0; i < 3; ++i) EXPECT_EQ(piece.vertex[piece.field.F(t, i)], F(piece.field.source[t], i));
    }
  }
}

}  // namespace
}  // namespace reflines
