#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "geometry/cage_border.h"
#include "tests/native/geometry/cages.h"

namespace reflines {
namespace {

constexpr auto kPosition = Border::kFixed;
constexpr auto kTangent = Border::kClamped;

// One condition all around.
Mask find_held_vertices(const Subdivision& subdivision, const Mask& region, Border border) {
  const std::vector<Border> everywhere(subdivision.positions.cols(), border);
  return reflines::find_held_vertices(subdivision, region, everywhere);
}

Mask everywhere(const Cage& cage) { return Mask::Constant(cage.face_offsets.size() - 1, true); }

SubdivisionOptions at(int level, bool limit, SubdivisionBoundary boundary = SubdivisionBoundary::kAll) {
  return {SubdivisionScheme::kCatmullClark, boundary, level, limit};
}

// The vertices on edges of one face only, and those in no face.
Mask border_ring(const Cage& cage) {
  Mask ring = Mask::Constant(cage.vertices, true);
  for (const int vertex : cage.face_vertices) ring[vertex] = false;
  for (const CageEdge& edge : cage_edges(cage)) {
    if (edge.faces == 1) ring[edge.first] = ring[edge.second] = true;
  }
  return ring;
}

// The ring and all that share a face with it.
Mask grown(const Cage& cage, const Mask& ring) {
  Mask result = ring;
  for (int f = 0; f + 1 < cage.face_offsets.size(); ++f) {
    const int begin = cage.face_offsets[f], size = cage.face_offsets[f + 1] - begin;
    const IndexVector face = cage.face_vertices.segment(begin, size);
    if (!ring(face).any()) continue;
    for (const int vertex : face) result[vertex] = true;
  }
  return result;
}

void expect_rings(const Cage& cage, const SubdivisionOptions& options) {
  const Subdivision result = subdivide(cage, options);
  const Mask ring = border_ring(cage);
  EXPECT_TRUE((find_held_vertices(result, everywhere(cage), kPosition) == ring).all());
  EXPECT_TRUE((find_held_vertices(result, everywhere(cage), kTangent) == grown(cage, ring)).all());
}

void expect_rings_at_all_levels(const Cage& cage) {
  using Boundary = SubdivisionBoundary;
  for (int level = 1; level <= 3; ++level) {
    for (const auto boundary : {Boundary::kAll, Boundary::kPreserveCorners}) {
      expect_rings(cage, at(level, true, boundary));
      expect_rings(cage, at(level, false, boundary));
    }
  }
}

TEST(CageBorder, PositionsNeedOneRingAndTangentsTwo) { expect_rings_at_all_levels(grid(6, 5).cage); }

TEST(CageBorder, ExtraordinaryVerticesChangeNothing) {
  for (const int valence : {3, 5, 7}) {
    expect_rings_at_all_levels(star(valence, 4).cage);
    // Without one sector the centre lies on the border, with `valence` - 1 faces.
    PlacedCage open = star(valence, 4);
    const int quads = static_cast<int>(open.cage.face_offsets.size() - 1) * (valence - 1) / valence;
    open.cage.face_offsets.conservativeResize(quads + 1);
    open.cage.face_vertices.conservativeResize(4 * quads);
    const int used = open.cage.face_vertices.maxCoeff() + 1;
    open.cage.vertices = used;
    expect_rings_at_all_levels(open.cage);
  }
}

TEST(CageBorder, PolygonsChangeNothing) {
  Cage cage = polygons(20, {{0, 1, 6, 5},
                            {1, 2, 7, 6},
                            {2, 3, 8, 7},
                            {3, 4, 9, 8},
                            {5, 6, 10},
                            {5, 10, 11, 12},
                            {6, 7, 13, 11, 10},
                            {7, 8, 14, 13},
                            {8, 9, 15, 14},
                            {12, 11, 17, 16},
                            {11, 13, 18, 17},
                            {13, 14, 15, 19, 18}});
  expect_rings_at_all_levels(cage);
}

TEST(CageBorder, CreasesAcrossAndAlongTheBorderChangeNothing) {
  for (const double sharpness : {0.7, 2.0, 10.0}) {
    PlacedCage across = grid(6, 6), along = grid(6, 6);
    for (int j = 0; j < 6; ++j) add_crease(&across.cage, 7 * j + 3, 7 * j + 10, sharpness);
    for (int i = 0; i < 6; ++i) add_crease(&along.cage, 7 + i, 8 + i, sharpness);
    expect_rings_at_all_levels(across.cage);
    expect_rings_at_all_levels(along.cage);
  }
}

TEST(CageBorder, SegmentsAreHeldUpToTheMiddleOfTheNextEdge) {
  constexpr int kRow = 9;  // vertices of a row of the grid
  const PlacedCage placed = grid(8, 8);
  std::vector<Border> border(placed.cage.vertices, Border::kFree);
  for (int v = 0; v < kRow; ++v) border[v] = v < 4 ? Border::kClamped : Border::kFixed;
  const Subdivision result = subdivide(placed.cage, at(2, true));
  const Mask held = reflines::find_held_vertices(result, everywhere(placed.cage), border);
  for (int v = 0; v < placed.cage.vertices; ++v) {
    const int x = v % kRow, y = v / kRow;
    // The surface at the middle of an edge depends on one vertex more, and so does the last held point on the sides.
    const bool on_segment = y == 0 || (y == 1 && x <= 4) || (y <= 2 && (x == 0 || x == 8)) || (y == 2 && x == 1);
    if (y == 0) EXPECT_TRUE(held[v]) << v;
    if (!on_segment && y > 2) EXPECT_FALSE(held[v]) << v;
    if (y == 1 && x > 5 && x < 8) EXPECT_FALSE(held[v]) << v;
    if (y == 1 && x > 0 && x <= 4) EXPECT_TRUE(held[v]) << v;
  }
}

TEST(CageBorder, HeldVerticesKeepTheBorderAndItsNormalsBitForBit) {
  for (const PlacedCage& placed : {grid(6, 6), star(5, 4)}) {
    const Subdivision result = subdivide(placed.cage, at(3, true));
    const Mask held = find_held_vertices(result, everywhere(placed.cage), kTangent);
    const Mask border = find_refined_border(result, everywhere(placed.cage));
    ASSERT_FALSE(held.all());
    Positions V = placed.V;
    for (int v = 0; v < V.rows(); ++v) V(v, 2) += held[v] ? 0.0 : 1.0 + v;
    const Positions before = result.positions * placed.V, after = result.positions * V;
    const Positions normals = limit_normals(result, placed.V), moved = limit_normals(result, V);
    int kept = 0;
    for (int i = 0; i < border.size(); ++i) {
      if (!border[i]) continue;
      EXPECT_EQ(before.row(i), after.row(i));
      EXPECT_EQ(normals.row(i), moved.row(i));
      ++kept;
    }
    EXPECT_GT(kept, 0);
    EXPECT_GT((before - after).cwiseAbs().maxCoeff(), 0.5);
  }
}

// Border and tangents determine every held vertex: no combination of them could have been left free.
TEST(CageBorder, NoneIsHeldWithoutNeed) {
  for (const PlacedCage& placed : {grid(5, 5), star(5, 3)}) {
    const Subdivision result = subdivide(placed.cage, at(2, true));
    const Mask held = find_held_vertices(result, everywhere(placed.cage), kTangent);
    const Mask border = find_refined_border(result, everywhere(placed.cage));
    std::vector<int> rows, columns;
    for (int i = 0; i < border.size(); ++i) {
      if (border[i]) rows.push_back(i);
    }
    for (int v = 0; v < held.size(); ++v) {
      if (held[v]) columns.push_back(v);
    }
    const int size = static_cast<int>(rows.size());
    Eigen::MatrixXd system(3 * size, columns.size());
    system << Eigen::MatrixXd(result.positions)(rows, columns), Eigen::MatrixXd(result.tangent_u)(rows, columns),
        Eigen::MatrixXd(result.tangent_v)(rows, columns);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(system);
    EXPECT_EQ(qr.rank(), static_cast<int>(columns.size()));
  }
}

// A region inside the surface: two rings for positions already, and everything outside stays.
TEST(CageBorder, InsideASurfaceBothNeedTwoRingsAndTheOutsideStays) {
  const int n = 10;
  const PlacedCage placed = grid(n, n);
  Mask region = Mask::Constant(n * n, false);
  for (int j = 2; j < 8; ++j) {
    for (int i = 2; i < 8; ++i) region[j * n + i] = true;
  }
  for (const bool limit : {false, true}) {
    const Subdivision result = subdivide(placed.cage, at(2, limit));
    const Mask held = find_held_vertices(result, region, kPosition);
    EXPECT_TRUE((held == find_held_vertices(result, region, kTangent)).all());
    Positions V = placed.V;
    for (int v = 0; v < V.rows(); ++v) {
      const int i = v % (n + 1), j = v / (n + 1);
      EXPECT_EQ(held[v], std::min({i, j, n - i, n - j}) < 4);
      V(v, 2) += held[v] ? 0.0 : 1.0;
    }
    const Positions after = result.positions * V;
    const Positions normals = limit_normals(result, V);
    for (int f = 0; f < result.faces.rows(); ++f) {
      if (region[result.face_parent[f]]) continue;
      for (const int vertex : result.faces.row(f)) {
        EXPECT_EQ(after(vertex, 2), 0.0);
        EXPECT_EQ(normals(vertex, 2), 1.0);
      }
    }
  }
}

TEST(CageBorder, AClosedSurfaceHoldsNothing) {
  const Subdivision result = subdivide(cube().cage, at(2, true));
  EXPECT_FALSE(find_held_vertices(result, everywhere(cube().cage), kTangent).any());
}

}  // namespace
}  // namespace reflines
