// The smoothing of gradients: its response to waves, what it keeps, and its cancelling (half a second with 250,000
// vertices).
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "optimization/linear/linear_solver.h"
#include "reflection/line_smoother.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

double bowl(double x, double y) { return 0.3 * x * x + 0.25 * y * y; }

constexpr double kLength = 0.12;

// The grid with each cell cut along one diagonal and the other by turns: vertices of four and eight triangles.
samples::Mesh four_eight(int n) {
  samples::Mesh mesh = samples::grid(n);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, first = 2 * (j * n + i);
      if ((i + j) % 2 == 0) continue;
      mesh.F.row(first) << a, a + 1, a + n + 1;
      mesh.F.row(first + 1) << a + 1, a + n + 2, a + n + 1;
    }
  }
  return mesh;
}

samples::Mesh stretched(samples::Mesh mesh, double factor) {
  mesh.V.col(0) *= factor;
  return mesh;
}

SpdSolve factorize(const SparseMatrix& matrix) {
  auto solver = std::make_shared<LinearSolver>(LinearSolverKind::kCholmod);
  solver->analyze(matrix);
  solver->factorize(matrix);
  return [solver](Vector& x) { solver->solve(x); };
}

Vector2 center(const HeightField& field, int t) {
  return (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))).transpose() / 3.0;
}

LineSmoother make_smoother(const HeightField& field, bool directional = false) {
  const int n = field.triangle_count();
  PlaneVectors across = PlaneVectors::Zero(n, 2);
  across.col(0).setOnes();  // lines along y
  return {field,
          make_smoother_elements(field),
          {kLength, directional},
          across,
          Vector::Ones(n),
          Mask::Constant(n, false),
          factorize};
}

// Returns the share of a wave that smoothing keeps in the middle of the unit square, or of one stretched along x.
double kept_share(const HeightField& field, const LineSmoother& smoother, double wavelength, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0, width = field.xy.col(0).maxCoeff();
  const Vector2 k = 2 * std::numbers::pi / wavelength * Vector2(std::cos(angle), std::sin(angle));
  PlaneVectors wave = PlaneVectors::Zero(field.triangle_count(), 2);
  for (int t = 0; t < wave.rows(); ++t) wave(t, 0) = std::cos(center(field, t).dot(k));
  const PlaneVectors smoothed = smoother.smooth(wave);
  double product = 0, square = 0;
  for (int t = 0; t < wave.rows(); ++t) {
    const Vector2 off = center(field, t).cwiseAbs();
    if (off.x() > width - 0.35 || off.y() > 0.15) continue;
    product += field.area(t) * smoothed(t, 0) * wave(t, 0);
    square += field.area(t) * wave(t, 0) * wave(t, 0);
  }
  return product / square;
}

// The response is the sharpened one of a thin plate, in all directions and however the quads are cut and stretched: the
// squared Hessians of the triangles' own stencils keep 0.55 of a wave as long as the length on a 4-8 mesh.
TEST(LineSmootherTest, KeepsAWaveByItsLengthAlone) {
  for (const samples::Mesh& mesh : {samples::grid(90), four_eight(90), samples::grid_with_valence_three(90, 3),
                                    stretched(samples::grid(90), 3.0)}) {
    const HeightField field = samples::height_field(mesh);
    const LineSmoother smoother = make_smoother(field);
    for (const double degrees : {0.0, 30.0, 90.0, 135.0}) {
      EXPECT_LT(std::abs(kept_share(field, smoother, 0.7 * kLength, degrees)), 0.05) << degrees;
      EXPECT_NEAR(kept_share(field, smoother, kLength, degrees), 0.5, 0.12) << degrees;
      EXPECT_GT(kept_share(field, smoother, 1.4 * kLength, degrees), 0.95) << degrees;
    }
  }
}

TEST(LineSmootherTest, SmoothsAlongTheLinesOnly) {
  for (const samples::Mesh& mesh : {samples::grid(90), four_eight(90)}) {
    const HeightField field = samples::height_field(mesh);
    const LineSmoother smoother = make_smoother(field, true);
    EXPECT_LT(std::abs(kept_share(field, smoother, 0.7 * kLength, 90.0)), 0.06);
    EXPECT_GT(kept_share(field, smoother, 0.5 * kLength, 0.0), 0.95);
  }
}

// The Hessian of a linear field is 0 up to the border.
TEST(LineSmootherTest, ChangesNoLinearField) {
  const HeightField field = samples::height_field(samples::grid_with_valence_three(12, 4));
  PlaneVectors linear(field.triangle_count(), 2);
  for (int t = 0; t < linear.rows(); ++t) {
    const Vector2 p = center(field, t);
    linear.row(t) << 3 * p.x() - p.y(), p.y();
  }
  EXPECT_LT((make_smoother(field).smooth(linear) - linear).cwiseAbs().maxCoeff(), 5e-3);
}

TEST(LineSmootherTest, IsCancelledBeforeItFactors) {
  const HeightField field = samples::height_field(samples::lifted(samples::grid(6), bowl));
  const SmootherElements elements = make_smoother_elements(field);
  const int n = field.triangle_count();
  int factorized = 0;
  const auto count = [&](const SparseMatrix&) -> SpdSolve {
    ++factorized;
    return [](Vector&) {};
  };
  const auto make = [&](const Progress* progress) {
    LineSmoother(field, elements, {0.3, false}, PlaneVectors(0, 2), Vector::Ones(n), Mask::Constant(n, false), count,
                 progress);
  };
  Progress progress;
  make(&progress);
  make(nullptr);
  EXPECT_EQ(factorized, 2);
  progress.cancel();
  EXPECT_THROW(make(&progress), Cancelled);
  EXPECT_EQ(factorized, 2);
}

}  // namespace
}  // namespace reflines
