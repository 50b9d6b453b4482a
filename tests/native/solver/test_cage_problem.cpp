// The problem of a cage: energy, gradient and Hessian through z = S x + c, and how well it is conditioned.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "geometry/cage_border.h"
#include "geometry/cage_symmetry.h"
#include "reflines/subdivision.h"
#include "solver/coupling.h"
#include "solver/piece_problem.h"

namespace reflines {
namespace {

// n x n quads over the unit square under a gentle crown, seen from +z.
struct Crown {
  Cage cage;
  Positions V;
};

Crown crown(int n) {
  Crown result;
  Eigen::MatrixXi faces(n * n, 4);
  result.V.resize((n + 1) * (n + 1), 3);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      const int a = j * (n + 1) + i;
      result.V.row(a) << x, y, 0.3 * x * (1 - x) + 0.2 * y * (1 - y) + 0.05 * std::sin(4 * x + 3 * y);
      if (i < n && j < n) faces.row(j * n + i) << a, a + 1, a + n + 2, a + n + 1;
    }
  }
  result.cage = cage_from_faces(static_cast<int>(result.V.rows()), faces);
  return result;
}

// The problem of a crown's whole surface with one family of lines along y, whose target is twice the lines' density.
PieceProblem problem_of(const Crown& crown, Border hold, int level, double proximity = -1.0) {
  const Subdivision surface = subdivide(crown.cage, {.level = level});
  const Mask region = Mask::Constant(crown.cage.face_offsets.size() - 1, true);
  const std::vector<Border> border(crown.cage.vertices, hold);
  const SparseMatrix B_cage = build_cage_unknowns(find_held_vertices(surface, region, border), {});
  const SparseMatrix B = surface.positions * B_cage;
  const Vector start = B_cage.transpose() * crown.V.col(2);
  Triangles F(2 * surface.faces.rows(), 3);
  for (int f = 0; f < surface.faces.rows(); ++f) {
    const auto q = surface.faces.row(f);
    F.row(2 * f) << q(0), q(1), q(2);
    F.row(2 * f + 1) << q(0), q(2), q(3);
  }
  const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
  Boundary boundary;
  boundary.border.assign(surface.positions.rows(), Border::kFree);
  HeightField field = make_height_field(surface.positions * crown.V, F, frame, boundary);
  const std::vector<int> free_unknowns = couple_vertices(B, start, field);
  Piece piece = std::move(split_pieces(field).front());
  AffineMap map = make_affine_map(B, start, free_unknowns, piece);
  const ReflectionFunction lines(frame, frame.z(), frame.y()), crossing(frame, frame.z(), frame.x());
  return {std::move(piece),
          std::move(map),
          SurfaceKind::kSubdivided,
          StencilKind::kConsistent,
          Families{{lines, crossing}, {}},
          proximity,
          LinearSolverKind::kCholmod};
}

void ask_for_denser_lines(PieceProblem& problem) {
  problem.set_targets({Target{2.0 * problem.lines(0).gradient, {}, {}, 0}});
}

Vector gradient_at(PieceProblem& problem, const Vector& x) {
  Vector gradient(problem.size());
  problem.evaluate(x, &gradient);
  return gradient;
}

Eigen::VectorXd eigenvalues(PieceProblem& problem) {
  const Eigen::MatrixXd H =
      Eigen::MatrixXd(problem.hessian(problem.unknowns(), HessianModel::kGaussNewton)).selfadjointView<Eigen::Lower>();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H, Eigen::EigenvaluesOnly).eigenvalues();
}

struct CageProblemTest : testing::Test {
  CageProblemTest() : bonnet(crown(6)), problem(problem_of(bonnet, Border::kFixed, 2)) {
    ask_for_denser_lines(problem);
    x = problem.unknowns() + 0.01 * (3.0 * Vector::LinSpaced(problem.size(), 0, 9)).array().sin().matrix();
  }
  Crown bonnet;
  PieceProblem problem;
  Vector x;
};

TEST_F(CageProblemTest, GradientIsThatOfTheEnergyAlongTheCage) {
  const Vector gradient = gradient_at(problem, x);
  const double h = 1e-6;
  for (int k = 0; k < problem.size(); ++k) {
    const Vector step = h * Vector::Unit(problem.size(), k);
    const double difference = (problem.evaluate(x + step, nullptr) - problem.evaluate(x - step, nullptr)) / (2 * h);
    EXPECT_NEAR(gradient(k), difference, 1e-6 * gradient.norm());
  }
}

// At a minimum of value 0, Gauss-Newton's matrix is the full Hessian.
TEST_F(CageProblemTest, HessianIsThatOfTheEnergyAlongTheCage) {
  problem.set_targets({Target{problem.lines(0).gradient, {}, {}, 0}});
  const Vector minimum = problem.unknowns();
  const Eigen::MatrixXd H =
      Eigen::MatrixXd(problem.hessian(minimum, HessianModel::kGaussNewton)).selfadjointView<Eigen::Lower>();
  const double h = 1e-6;
  for (int k = 0; k < problem.size(); ++k) {
    const Vector step = h * Vector::Unit(problem.size(), k);
    const Vector difference = (gradient_at(problem, minimum + step) - gradient_at(problem, minimum - step)) / (2 * h);
    EXPECT_LT((H.col(k) - difference).norm(), 1e-6 * H.norm());
  }
}

TEST_F(CageProblemTest, LinearizedAndNewtonHaveTheSamePattern) {
  const SparseMatrix first = problem.hessian(x, HessianModel::kGaussNewton);
  for (const HessianModel model : {HessianModel::kLinearized, HessianModel::kNewton}) {
    const SparseMatrix& other = problem.hessian(x, model);
    ASSERT_EQ(other.nonZeros(), first.nonZeros());
    EXPECT_EQ(SparseMatrix(other - first).nonZeros(), first.nonZeros());
  }
}

// One family of lines and few samples are enough where the border is held.
TEST(CageConditionTest, AHeldBorderDeterminesTheCage) {
  for (const Border hold : {Border::kFixed, Border::kClamped}) {
    for (const int level : {1, 2}) {
      const Crown bonnet = crown(10);
      PieceProblem problem = problem_of(bonnet, hold, level, 0.0);
      ask_for_denser_lines(problem);
      const Eigen::VectorXd values = eigenvalues(problem);
      EXPECT_GT(values(0), 1e-3 * values(values.size() - 1)) << "level " << level;
    }
  }
}

TEST(CageConditionTest, AFreeBorderIsDeterminedByTheRegulariserAlone) {
  const Crown bonnet = crown(10);
  PieceProblem without = problem_of(bonnet, Border::kFree, 1, 0.0), with = problem_of(bonnet, Border::kFree, 1);
  ask_for_denser_lines(without);
  ask_for_denser_lines(with);
  const Eigen::VectorXd bare = eigenvalues(without), held = eigenvalues(with);
  const double largest = held(held.size() - 1);
  EXPECT_LT(bare(0), 1e-13 * largest);
  EXPECT_GT(held(0), 1e-10 * largest);
}

TEST(CageConditionTest, VerticesThatNoSampleSeesHardlyMove) {
  const Crown bonnet = crown(10);
  PieceProblem problem = problem_of(bonnet, Border::kFixed, 1);
  const PlaneVectors field = problem.lines(0).gradient;
  Target target{1.2 * field, Vector::Zero(field.rows()), {}, 0};
  for (int t = 0; t < field.rows(); ++t) target.weight(t) = problem.field().xy(problem.field().F(t, 0), 0) < 0;
  problem.set_targets({target});
  EXPECT_GT(eigenvalues(problem)(0), 0.0);
  const Vector before = problem.unknowns();
  EXPECT_TRUE(problem.minimize({}, nullptr).converged());
  const Vector move = (problem.unknowns() - before).cwiseAbs();
  EXPECT_GT(move.maxCoeff(), 1e-4);
  EXPECT_LT(move(problem.size() - 1), 0.1 * move.maxCoeff());  // the far corner, whose samples all weigh nothing
}

}  // namespace
}  // namespace reflines
