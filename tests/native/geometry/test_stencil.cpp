#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "geometry/derivatives.h"
#include "geometry/stencil.h"
#include "geometry/stencil_quality.h"
#include "reflines/errors.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

// f = 0.3 + 0.2 x - 0.5 y + x^2 - 0.7 xy + 0.4 y^2: f_xx = 2, f_xy = -0.7, f_yy = 0.8.
double quadratic(double x, double y) { return 0.3 + 0.2 * x - 0.5 * y + x * x - 0.7 * x * y + 0.4 * y * y; }

// Rounding of second differences: weights of size 10 / h^2 on heights of size 1.
double rounding(int n) { return 1e-12 * n * n; }

double largest_hessian_error(const samples::Mesh& flat, StencilKind kind, bool inner_only = false) {
  const HeightField field = samples::height_field(samples::lifted(flat, quadratic));
  TriangleDerivatives u;
  apply_stencils(make_stencils(field, kind), field.z, u);
  double error = 0;
  for (int t = 0; t < field.triangle_count(); ++t) {
    if (inner_only && field.neighbors.row(t).minCoeff() < 0) continue;
    error = std::max(error, (u.row(t).tail<3>() - Eigen::RowVector3d(2, -0.7, 0.8)).cwiseAbs().maxCoeff());
  }
  return error;
}

TEST(Stencil, ConsistentIsExactOnQuadraticsOnEveryMeshUpToItsBorder) {
  EXPECT_LT(largest_hessian_error(samples::grid(8), StencilKind::kConsistent), rounding(8));
  EXPECT_LT(largest_hessian_error(samples::grid(8, 0.3), StencilKind::kConsistent), rounding(8));
  EXPECT_LT(largest_hessian_error(samples::grid_with_valence_three(6, 3), StencilKind::kConsistent), 10 * rounding(6));
}

TEST(Stencil, RingsAtPolesReadFewVerticesSpreadAround) {
  for (const int spokes : {17, 18, 200}) {
    const samples::Mesh flat = samples::disc(spokes);
    const HeightField field = samples::height_field(samples::lifted(flat, quadratic));
    const HessianStencil stencil = ring_hessian(field, 0);
    EXPECT_LE(stencil.vertex.size(), 26u);  // at the pole 16, and around the two other corners their own
    double across = 0;
    for (const int v : stencil.vertex) across = std::min(across, field.xy.row(v).dot(field.xy.row(1)));
    EXPECT_LT(across, -0.95 * field.xy.row(1).squaredNorm());
    EXPECT_LT(stencil.weight.cwiseAbs().maxCoeff(), 1.0 / field.xy.row(1).squaredNorm());
    EXPECT_LT(largest_hessian_error(flat, StencilKind::kConsistent), 1e-9 * spokes * spokes);
  }
}

TEST(Stencil, AveragedIsExactInsideRegularMeshesAndTheirAffineImagesOnly) {
  samples::Mesh sheared = samples::grid(8);
  sheared.V.col(0) += 0.4 * sheared.V.col(1);
  EXPECT_LT(largest_hessian_error(samples::grid(8), StencilKind::kAveraged, true), rounding(8));
  EXPECT_LT(largest_hessian_error(sheared, StencilKind::kAveraged, true), rounding(8));
  EXPECT_GT(largest_hessian_error(samples::grid(8, 0.3), StencilKind::kAveraged, true), 0.1);
}

TEST(Stencil, QuadraticIsExactWhereItIsDefined) {
  const HeightField field = samples::height_field(samples::lifted(samples::grid(8, 0.2), quadratic));
  int defined = 0;
  for (int t = 0; t < field.triangle_count(); ++t) {
    const HessianStencil stencil = quadratic_hessian(field, t);
    EXPECT_EQ(stencil.empty(), field.neighbors.row(t).minCoeff() < 0);
    if (stencil.empty()) continue;
    ++defined;
    Vector3 hessian = Vector3::Zero();
    for (size_t k = 0; k < stencil.vertex.size(); ++k) hessian += stencil.weight.col(k) * field.z(stencil.vertex[k]);
    EXPECT_LT((hessian - Vector3(2, -0.7, 0.8)).norm(), rounding(8) * stencil_magnitude(field, stencil));
  }
  EXPECT_EQ(defined, 2 * 8 * 8 - 4 * 8 + 2);  // all but those on the border (two corners have two border edges)
}

TEST(Stencil, ConicFormAgreesWithASixBySixSolve) {
  const HeightField field = samples::height_field(samples::grid(6, 0.25));
  for (int t = 0; t < field.triangle_count(); ++t) {
    const HessianStencil stencil = quadratic_hessian(field, t);
    if (stencil.empty()) continue;
    Eigen::Matrix<double, 6, 6> M;  // rows: the six points; columns: 1, x, y, x^2/2, xy, y^2/2
    for (int k = 0; k < 6; ++k) {
      const Vector2 p = field.xy.row(stencil.vertex[k]) - field.xy.row(stencil.vertex[0]);
      M.row(k) << 1, p.x(), p.y(), p.x() * p.x() / 2, p.x() * p.y(), p.y() * p.y() / 2;
    }
    const Eigen::MatrixXd expected = M.fullPivLu().inverse().bottomRows<3>();
    EXPECT_LT((stencil.weight - expected).norm(), 1e-9 * expected.norm()) << "triangle " << t;
  }
}

TEST(Stencil, SixPointsOnACircleAreFoundByTheConicTest) {
  // A triangle and its three neighbours, all six vertices on the unit circle.
  samples::Mesh mesh;
  mesh.V.resize(6, 3);
  for (int k = 0; k < 6; ++k)
    mesh.V.row(k) << std::cos(k * std::numbers::pi / 3), std::sin(k * std::numbers::pi / 3), 0;
  mesh.F.resize(4, 3);
  mesh.F << 0, 2, 4, 0, 1, 2, 2, 3, 4, 4, 5, 0;
  const HeightField field = samples::height_field(mesh);
  EXPECT_TRUE(quadratic_hessian(field, 0).empty());
  EXPECT_THROW(make_stencils(field, StencilKind::kQuadratic), InvalidInput);
  EXPECT_EQ(make_stencils(field, StencilKind::kConsistent).fallback_count, 4);
}

TEST(Stencil, GradientIsExactOnLinearFunctions) {
  const HeightField field = samples::height_field(
      samples::lifted(samples::grid(6, 0.3), [](double x, double y) { return 3 * x - 2 * y + 1; }));
  TriangleDerivatives u;
  apply_stencils(make_stencils(field, StencilKind::kConsistent), field.z, u);
  EXPECT_LT((u.col(0).array() - 3).abs().maxCoeff(), 1e-13);
  EXPECT_LT((u.col(1).array() + 2).abs().maxCoeff(), 1e-13);
  EXPECT_LT(u.rightCols<3>().cwiseAbs().maxCoeff(), rounding(6));
}

TEST(Stencil, TransposedProductIsTheAdjoint) {
  const HeightField field = samples::height_field(samples::grid_with_valence_three(5, 2));
  const Stencils stencils = make_stencils(field, StencilKind::kConsistent);
  const StencilEntries entries(stencils, field.vertex_count());
  const Vector z = Vector::Random(field.vertex_count());
  const TriangleDerivatives y = TriangleDerivatives::Random(field.triangle_count(), 5);
  TriangleDerivatives u;
  Vector products(stencils.vertex.size()), transposed;
  apply_stencils(stencils, z, u);
  for (int t = 0; t < field.triangle_count(); ++t) multiply_stencil(stencils, t, y.row(t), products);
  sum_products(entries, products, transposed);
  EXPECT_NEAR(u.cwiseProduct(y).sum(), z.dot(transposed), 1e-9 * u.norm() * y.norm());
}

TEST(Stencil, HybridFallsBackWhereThePaperSays) {
  const HeightField field = samples::height_field(samples::grid(16, 0.2));
  const Stencils hybrid = make_stencils(field, StencilKind::kHybrid);
  int unstable = 0;
  for (int t = 0; t < field.triangle_count(); ++t) {
    const HessianStencil six = quadratic_hessian(field, t);
    unstable += six.empty() || stencil_magnitude(field, six) > 5;
  }
  EXPECT_EQ(hybrid.fallback_count, unstable);
  EXPECT_GT(unstable, 0);
}

}  // namespace
}  // namespace reflines
