// The problem of a symmetric mesh is that of the whole mesh, restricted to moves that mirror images share.
#include <gtest/gtest.h>

#include "reflines/errors.h"
#include "solver/coupling.h"
#include "solver/mirror_coupling.h"
#include "solver/piece_problem.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr int kCells = 9;  // odd: no column lies on the plane, whose cells every stencil crosses with its own image

// The mirror images of a grid's vertices across x = 1/2.
IndexVector images(int n) {
  IndexVector partner((n + 1) * (n + 1));
  for (int v = 0; v < partner.size(); ++v) partner(v) = v - v % (n + 1) + n - v % (n + 1);
  return partner;
}

// A crowned grid, cut along one diagonal, so that the triangles of the halves are no images of each other.
HeightField crowned(int n, Border border) {
  return samples::height_field(
      samples::lifted(samples::grid(n), [](double x, double y) { return 0.3 * x * (1 - x) + 0.2 * y * (1 - y); }),
      border);
}

PieceProblem problem_of(const HeightField& field, const IndexVector& partner) {
  const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
  const ReflectionFunction lines(frame, frame.z(), frame.y()), crossing(frame, frame.z(), frame.x());
  Piece piece = std::move(split_pieces(field, partner).front());
  AffineMap map = make_affine_map({}, {}, {}, piece);
  return {std::move(piece),
          std::move(map),
          SurfaceKind::kMesh,
          StencilKind::kConsistent,
          Families{{lines, crossing}, {}},
          -1.0,
          LinearSolverKind::kCholmod};
}

void ask_for_denser_lines(PieceProblem& problem) {
  problem.set_targets({Target{1.5 * problem.lines(0).gradient, {}, {}, 0}});
}

struct SymmetricProblemTest : testing::TestWithParam<Border> {
  SymmetricProblemTest()
      : field(crowned(kCells, GetParam())),
        whole(problem_of(field, {})),
        half(problem_of(field, images(kCells))),
        spread(whole.size(), half.size()) {
    ask_for_denser_lines(whole);
    ask_for_denser_lines(half);
    // Vertices of both problems come in the order of their triangles; row r of B is the r-th free vertex.
    const std::vector<int>& vertices = half.vertices();
    const std::vector<int> leader = choose_leaders(split_pieces(field, images(kCells)).front());
    std::vector<int> unknown(leader.size(), -1);
    int count = 0, row = 0;
    for (size_t v = 0; v < leader.size(); ++v) {
      if (leader[v] == static_cast<int>(v)) unknown[v] = count++;
    }
    spread.setZero();
    for (size_t v = 0; v < vertices.size(); ++v) {
      if (leader[v] >= 0) spread(row++, unknown[leader[v]]) = 1;
    }
    x = half.unknowns() + 0.01 * Vector::LinSpaced(half.size(), 0, 20).array().sin().matrix();
    z = whole.unknowns() + spread * (x - half.unknowns());
  }
  HeightField field;
  PieceProblem whole, half;
  Eigen::MatrixXd spread;  // B of z = B x + c over the free vertices
  Vector x, z;
};

INSTANTIATE_TEST_SUITE_P(Borders, SymmetricProblemTest, testing::Values(Border::kFree, Border::kClamped));

TEST_P(SymmetricProblemTest, EnergyAndGradientAreThoseOfTheWholeAlongSharedMoves) {
  ASSERT_EQ(2 * half.size(), whole.size());
  Vector own(half.size()), gradient(whole.size());
  const double energy = half.evaluate(x, &own);
  EXPECT_NEAR(energy, whole.evaluate(z, &gradient), 1e-11 * energy);
  EXPECT_LT((own - spread.transpose() * gradient).norm(), 1e-10 * gradient.norm());
}

TEST_P(SymmetricProblemTest, HessianIsThatOfTheWholeOverSharedMoves) {
  for (const HessianModel model : {HessianModel::kGaussNewton, HessianModel::kNewton}) {
    const Eigen::MatrixXd own = Eigen::MatrixXd(half.hessian(x, model)).selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd all = Eigen::MatrixXd(whole.hessian(z, model)).selfadjointView<Eigen::Lower>();
    EXPECT_LT((own - spread.transpose() * all * spread).norm(), 1e-10 * all.norm());
  }
}

// Unknowns that are far apart in the plane would spoil the order of elimination.
TEST_P(SymmetricProblemTest, UnknownsLieOnOneSideOfThePlane) {
  const PlanePositions places = half.places();
  EXPECT_LT(places.col(0).maxCoeff() - places.col(0).minCoeff(), 0.5);
}

TEST(MirrorCouplingTest, HalvesThatDoNotTouchAreOnePieceOfTwoParts) {
  samples::Mesh mesh = samples::grid(4);
  const int n = static_cast<int>(mesh.V.rows()), triangles = static_cast<int>(mesh.F.rows());
  mesh.V.conservativeResize(2 * n, 3);
  mesh.F.conservativeResize(2 * triangles, 3);
  mesh.V.bottomRows(n) = mesh.V.topRows(n).rowwise() + Eigen::RowVector3d(2, 0, 0);
  mesh.F.bottomRows(triangles) = mesh.F.topRows(triangles).array() + n;
  const HeightField field = samples::height_field(mesh);
  IndexVector partner(2 * n);
  for (int v = 0; v < 2 * n; ++v) partner(v) = (v + n) % (2 * n);
  const std::vector<Piece> pieces = split_pieces(field, partner);
  EXPECT_EQ(split_pieces(field).size(), 2U);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].field.piece_count, 2);
  EXPECT_NEAR(pieces[0].field.piece_diagonal(), std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(pieces[0].field.diagonal(), std::sqrt(10.0), 1e-12);
}

TEST(MirrorCouplingTest, TheFirmerOfTwoRolesHolds) {
  HeightField field = crowned(4, Border::kFree);
  const IndexVector partner = images(4);
  field.role[7] = VertexRole::kClamped;
  field.role[11] = VertexRole::kUnused;
  hold_partners(partner, field);
  EXPECT_EQ(field.role[5], VertexRole::kFree);  // of 5 in a row 6 and 8 are a pair, 7 is its own image
  EXPECT_EQ(field.role[7], VertexRole::kClamped);
  EXPECT_EQ(field.role[13], VertexRole::kFixed);
  field.role[6] = VertexRole::kFixed;
  hold_partners(partner, field);
  EXPECT_EQ(field.role[8], VertexRole::kFixed);
}

TEST(MirrorCouplingTest, LimitsOfBothPartnersHold) {
  const MoveLimit limit{Vector::LinSpaced(25, -25, -1), Vector::LinSpaced(25, 1, 25)};
  const MoveLimit both = intersect_limits(limit, images(4));
  EXPECT_EQ(both.highest(3), 2);
  EXPECT_EQ(both.highest(1), 2);
  EXPECT_EQ(both.lowest(1), -22);
  EXPECT_EQ(both.lowest(3), -22);
}

}  // namespace
}  // namespace reflines
