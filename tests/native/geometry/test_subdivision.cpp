#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "reflines/subdivision.h"
#include "tests/native/geometry/cages.h"

namespace reflines {
namespace {

using Scheme = SubdivisionScheme;
using Boundary = SubdivisionBoundary;

SubdivisionOptions with(int level, bool limit, Boundary boundary = Boundary::kAll) {
  return {Scheme::kCatmullClark, boundary, level, limit};
}

double weight(const SparseMatrix& matrix, int row, int column) { return matrix.coeff(row, column); }

int entries(const SparseMatrix& matrix, int row) {
  return static_cast<int>((Vector(matrix.row(row)).array() != 0).count());
}

double largest(const SparseMatrix& matrix) { return Eigen::MatrixXd(matrix).cwiseAbs().maxCoeff(); }

// Heights that no symmetry or linear precision can explain away.
Positions bumpy(Positions V) {
  for (int i = 0; i < V.rows(); ++i) V(i, 2) += 0.3 * std::sin(12.9898 * i + 1);
  return V;
}

std::vector<PlacedCage> all_cages() {
  std::vector<PlacedCage> cages = {grid(3, 2), cube(), pentagonal_prism(), octahedron(), star(3, 2), star(5, 2)};
  PlacedCage creased = cube();
  add_crease(&creased.cage, 0, 1, 10);
  add_crease(&creased.cage, 1, 5, 2.5);
  creased.cage.corners = IndexVector::Constant(1, 6);
  creased.cage.corner_sharpness = Vector::Constant(1, 3.0);
  cages.push_back(creased);
  cages.push_back({polygons(8, {{0, 1, 2, 3}, {1, 0, 4, 5}, {0, 1, 6, 7}}), Positions::Random(8, 3)});  // a fin
  cages.push_back({polygons(7, {{0, 1, 2, 3}, {0, 4, 5, 6}}), Positions::Random(7, 3)});                // a bow tie
  cages.push_back({polygons(6, {{0, 1, 2, 3}}), Positions::Random(6, 3)});  // two loose vertices
  return cages;
}

TEST(Subdivision, MovingTheCageMovesTheSurfaceAndNotItsTangents) {
  for (const PlacedCage& placed : all_cages()) {
    for (int variant = 0; variant < 12; ++variant) {
      const auto boundary = variant % 2 == 0 ? Boundary::kAll : Boundary::kPreserveCorners;
      const Subdivision result = subdivide(placed.cage, with(1 + variant / 4, variant / 2 % 2 == 0, boundary));
      const Vector one = Vector::Ones(placed.cage.vertices);
      EXPECT_LT(((result.positions * one).array() - 1).abs().maxCoeff(), 1e-14);
      EXPECT_LT((result.tangent_u * one).cwiseAbs().maxCoeff(), 1e-14);
      EXPECT_LT((result.tangent_v * one).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TEST(Subdivision, InteriorOfAPlaneGridIsTheFinerGrid) {
  const int n = 5, level = 2;
  const PlacedCage placed = grid(n, n);
  for (const bool limit : {false, true}) {
    const Subdivision result = subdivide(placed.cage, with(level, limit));
    const Positions V = result.positions * placed.V;
    ASSERT_EQ(result.faces.rows(), n * n * 16);
    for (int f = 0; f < result.faces.rows(); ++f) {
      const int i = result.face_parent[f] % n, j = result.face_parent[f] / n;
      if (std::min(i, j) == 0 || std::max(i, j) == n - 1) continue;
      const Vector3 a = V.row(result.faces(f, 0)), b = V.row(result.faces(f, 1)), c = V.row(result.faces(f, 2));
      const Vector3 middle = (a + c) / 2;
      EXPECT_TRUE(i < middle.x() && middle.x() < i + 1 && j < middle.y() && middle.y() < j + 1);
      const double area = (b - a).x() * (c - b).y() - (b - a).y() * (c - b).x();  // positive: still counter-clockwise
      EXPECT_NEAR(area, 1.0 / 16, 1e-14);
    }
  }
}

TEST(Subdivision, LimitOfARegularVertexIsTheBicubicSpline) {
  const Subdivision result = subdivide(grid(4, 4).cage, with(2, true));
  const int middle = 12;
  EXPECT_EQ(entries(result.positions, middle), 9);
  EXPECT_NEAR(weight(result.positions, middle, middle), 4.0 / 9, 1e-15);
  for (const int edge : {7, 11, 13, 17}) EXPECT_NEAR(weight(result.positions, middle, edge), 1.0 / 9, 1e-15);
  for (const int face : {6, 8, 16, 18}) EXPECT_NEAR(weight(result.positions, middle, face), 1.0 / 36, 1e-15);
}

TEST(Subdivision, LoopLimitOfARegularVertexIsTheBoxSpline) {
  PlacedCage placed = grid(4, 4);
  std::vector<std::vector<int>> triangles;
  for (int f = 0; f < 16; ++f) {
    const auto q = placed.cage.face_vertices.segment<4>(4 * f);
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  const Cage cage = polygons(25, triangles);
  const Subdivision result = subdivide(cage, {Scheme::kLoop, Boundary::kAll, 2, true});
  EXPECT_EQ(result.faces.cols(), 3);
  EXPECT_EQ(result.faces.rows(), 32 * 16);
  EXPECT_NEAR(weight(result.positions, 12, 12), 0.5, 1e-15);
  for (const int neighbour : {6, 7, 11, 13, 17, 18}) {
    EXPECT_NEAR(weight(result.positions, 12, neighbour), 1.0 / 12, 1e-15);
  }
}

// The border of the cage is the cage of a cubic spline: 1/6, 4/6, 1/6 at its vertices, whatever lies inside.
TEST(Subdivision, BordersAndSharpCreasesAreSplinesOfTheirOwn) {
  PlacedCage placed = grid(4, 4);
  for (int i = 0; i < 4; ++i) add_crease(&placed.cage, 10 + i, 11 + i, 10);
  const Subdivision result = subdivide(placed.cage, with(1, true));
  for (const int row : {2, 12}) {
    EXPECT_EQ(entries(result.positions, row), 3);
    EXPECT_NEAR(weight(result.positions, row, row), 4.0 / 6, 1e-15);
    EXPECT_NEAR(weight(result.positions, row, row - 1), 1.0 / 6, 1e-15);
    EXPECT_NEAR(weight(result.positions, row, row + 1), 1.0 / 6, 1e-15);
  }
}

TEST(Subdivision, CornersOfASheetStayOnlyWhereAskedFor) {
  const Cage cage = grid(2, 2).cage;
  const Subdivision kept = subdivide(cage, with(2, true, Boundary::kPreserveCorners));
  EXPECT_EQ(entries(kept.positions, 0), 1);
  EXPECT_EQ(weight(kept.positions, 0, 0), 1.0);
  const Subdivision smooth = subdivide(cage, with(2, true));
  EXPECT_NEAR(weight(smooth.positions, 0, 0), 4.0 / 6, 1e-15);
  EXPECT_NEAR(weight(smooth.positions, 0, 1), 1.0 / 6, 1e-15);
  EXPECT_NEAR(weight(smooth.positions, 0, 3), 1.0 / 6, 1e-15);
}

TEST(Subdivision, CreasedBorderEdgesKeepTheCornerBetweenThem) {
  PlacedCage placed = grid(1, 1);
  add_crease(&placed.cage, 0, 1, 10);
  add_crease(&placed.cage, 2, 0, 10);
  const Subdivision result = subdivide(placed.cage, with(3, true));
  EXPECT_EQ(weight(result.positions, 0, 0), 1.0);
  EXPECT_EQ(entries(result.positions, 1), 3);
}

TEST(Subdivision, SharpnessZeroIsNoCreaseBitForBit) {
  PlacedCage placed = cube();
  const Subdivision smooth = subdivide(placed.cage, with(2, true));
  add_crease(&placed.cage, 0, 1, 0);
  const Subdivision zero = subdivide(placed.cage, with(2, true));
  EXPECT_EQ(largest(smooth.positions - zero.positions), 0);
}

TEST(Subdivision, ASharperCreaseStaysCloserToItsEdge) {
  double before = 0;
  for (const double sharpness : {0.0, 0.5, 1.0, 2.0, 3.5, 10.0}) {
    PlacedCage placed = cube();
    for (const auto& [a, b] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}}) add_crease(&placed.cage, a, b, sharpness);
    const Subdivision result = subdivide(placed.cage, with(4, false));
    const double height = (result.positions * placed.V)(4, 2);
    EXPECT_GT(height, before);
    before = height;
  }
  EXPECT_NEAR(before, 1.0, 1e-15);  // sharp all around: the rim stays in its plane
}

TEST(Subdivision, VerticesInNoFaceStay) {
  const Subdivision result = subdivide(polygons(6, {{0, 1, 2, 3}}), with(2, true));
  for (const int loose : {4, 5}) {
    EXPECT_EQ(entries(result.positions, loose), 1);
    EXPECT_EQ(weight(result.positions, loose, loose), 1.0);
    EXPECT_EQ(entries(result.tangent_u, loose), 0);
  }
}

TEST(Subdivision, MiddlesOfFacesFollowTheVerticesOfTheCage) {
  const PlacedCage placed = pentagonal_prism();
  const Positions V = subdivide(placed.cage, with(1, false)).positions * placed.V;
  for (int f = 0; f < 7; ++f) {
    const int begin = placed.cage.face_offsets[f], size = placed.cage.face_offsets[f + 1] - begin;
    const IndexVector corners = placed.cage.face_vertices.segment(begin, size);
    EXPECT_LT((V.row(10 + f) - placed.V(corners, Eigen::all).colwise().mean()).norm(), 1e-15);
  }
}

TEST(Subdivision, LevelTwoIsLevelOneOfLevelOne) {
  for (const PlacedCage& placed : {grid(3, 2), cube(), pentagonal_prism(), star(5, 2)}) {
    const Positions V = bumpy(placed.V);
    const Subdivision once = subdivide(placed.cage, with(1, false)), twice = subdivide(placed.cage, with(2, false));
    const int vertices = static_cast<int>(once.positions.rows());
    const Subdivision again = subdivide(cage_from_faces(vertices, once.faces), with(1, false));
    const Positions expected = twice.positions * V, composed = again.positions * Positions(once.positions * V);
    ASSERT_EQ(expected.rows(), composed.rows());
    for (int i = 0; i < composed.rows(); ++i) {  // vertices that a level adds may be numbered otherwise
      EXPECT_LT((expected.rowwise() - composed.row(i)).rowwise().norm().minCoeff(), 1e-14);
    }
    EXPECT_LT((expected.topRows(vertices) - composed.topRows(vertices)).norm(), 1e-13);
  }
}

TEST(Subdivision, TheLimitDoesNotDependOnTheLevel) {
  for (const PlacedCage& placed : {grid(3, 2), cube(), pentagonal_prism(), star(3, 2), star(6, 2)}) {
    const Positions V = bumpy(placed.V);
    const Subdivision coarse = subdivide(placed.cage, with(1, true)), fine = subdivide(placed.cage, with(3, true));
    const int shared = static_cast<int>(coarse.positions.rows());
    EXPECT_LT((Positions(coarse.positions * V) - (fine.positions * V).eval().topRows(shared)).norm(), 1e-13);
    EXPECT_LT((limit_normals(coarse, V) - limit_normals(fine, V).topRows(shared)).norm(), 1e-12);
  }
}

TEST(Subdivision, RefinedPositionsApproachTheLimit) {
  const PlacedCage placed = star(5, 2);
  const Positions V = bumpy(placed.V);
  double before = 1;
  for (int level = 1; level <= 4; ++level) {
    const Subdivision refined = subdivide(placed.cage, with(level, false));
    const Subdivision limit = subdivide(placed.cage, with(level, true));
    const double distance = ((refined.positions - limit.positions) * V).rowwise().norm().maxCoeff();
    EXPECT_LT(distance, 0.5 * before);
    before = distance;
  }
}

TEST(Subdivision, NormalsOfAPlaneAreThePlanesEverywhere) {
  for (PlacedCage placed : {grid(3, 3), star(3, 2), star(5, 2), star(7, 2)}) {
    add_crease(&placed.cage, 0, 1, 10);
    for (const auto boundary : {Boundary::kAll, Boundary::kPreserveCorners}) {
      const Positions normals = limit_normals(subdivide(placed.cage, with(2, true, boundary)), placed.V);
      EXPECT_LT((normals.rowwise() - Eigen::RowVector3d(0, 0, 1)).norm(), 1e-12);
    }
  }
}

// Against the faces around each vertex, four levels deeper.
TEST(Subdivision, NormalsAreThoseOfTheFinestFaces) {
  for (const PlacedCage& placed : {cube(), pentagonal_prism(), octahedron(), star(5, 2)}) {
    const Positions V = bumpy(placed.V);
    const Subdivision coarse = subdivide(placed.cage, with(1, true)), fine = subdivide(placed.cage, with(5, true));
    const Positions P = fine.positions * V, normals = limit_normals(coarse, V);
    for (int f = 0; f < fine.faces.rows(); ++f) {
      for (int i = 0; i < 4; ++i) {
        const int vertex = fine.faces(f, i);
        if (vertex >= normals.rows()) continue;
        const Vector3 to = P.row(fine.faces(f, (i + 1) % 4)) - P.row(vertex);
        const Vector3 from = P.row(fine.faces(f, (i + 3) % 4)) - P.row(vertex);
        EXPECT_GT(to.cross(from).normalized().dot(normals.row(vertex)), 0.97);
      }
    }
  }
}

TEST(Subdivision, WhereTheTangentsAreParallelTheNormalIsZ) {
  PlacedCage placed = grid(4, 4);
  placed.V = placed.V.col(0) * Eigen::RowVector3d(0.1, 0.7, 0.3);  // all on a line
  placed.V.rowwise() += Eigen::RowVector3d(10, 20, 30);
  const Positions normals = limit_normals(subdivide(placed.cage, with(2, true)), placed.V);
  EXPECT_EQ((normals.rowwise() - Eigen::RowVector3d(0, 0, 1)).norm(), 0);
}

}  // namespace
}  // namespace reflines
