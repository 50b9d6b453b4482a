#include <gtest/gtest.h>

#include "geometry/normal_fit.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

TEST(NormalFit, IsExactOnAQuadraticGraphSeenAlongItsNormal) {
  // Heights over the plane of the fit are a quadratic only at the apex, where the initial normal is the axis.
  const samples::Mesh mesh = samples::lifted(
      samples::grid(6), [](double x, double y) { return 0.4 * ((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5)); });
  NormalFit fit(mesh.V, mesh.F);
  const Positions N = fit.normals(mesh.V);
  EXPECT_LT((N.row(3 * 7 + 3) - Eigen::RowVector3d(0, 0, 1)).norm(), 1e-12);
}

// Largest angle to the true normal on a jittered cylinder patch of radius 1.
double cylinder_error(int n) {
  const samples::Mesh mesh =
      samples::lifted(samples::grid(n, 0.3), [](double x, double) { return std::sqrt(1 - (x - 0.5) * (x - 0.5)); });
  NormalFit fit(mesh.V, mesh.F);
  const Positions N = fit.normals(mesh.V);
  double error = 0;
  for (int v = 0; v < N.rows(); ++v) {
    const Vector3 true_normal(mesh.V(v, 0) - 0.5, 0, mesh.V(v, 2));
    error = std::max(error, std::acos(std::min(1.0, N.row(v).dot(true_normal))));
  }
  return error;
}

TEST(NormalFit, ConvergesAtSecondOrderOnIrregularMeshesUpToTheBorder) {
  const double coarse = cylinder_error(16), fine = cylinder_error(32);
  EXPECT_LT(fine, 2e-3);
  EXPECT_LT(fine, coarse / 2.8);
}

TEST(NormalFit, KeepsItsCoefficientsForSmallMotionsAndRefitsForLarge) {
  const samples::Mesh flat = samples::grid(8, 0.2);
  NormalFit fit(flat.V, flat.F, 0.35);
  const auto tilted = [&](double slope) {
    return samples::lifted(flat, [=](double x, double) { return slope * x; }).V;
  };
  EXPECT_LT((fit.normals(tilted(0.1)).row(40) - Eigen::RowVector3d(-0.1, 0, 1).normalized()).norm(), 1e-12);
  EXPECT_EQ(fit.refit_count(), 0);
  EXPECT_LT((fit.normals(tilted(1.0)).row(40) - Eigen::RowVector3d(-1, 0, 1).normalized()).norm(), 1e-12);
  EXPECT_EQ(fit.refit_count(), flat.V.rows());
}

TEST(NormalFit, RefitsNothingThatHasNotTurnedHoweverSmallTheAngle) {
  const samples::Mesh mesh =
      samples::lifted(samples::grid(8, 0.3), [](double x, double y) { return x * x * x + 0.5 * y * y; });
  NormalFit fit(mesh.V, mesh.F, 1e-6);
  const Positions N = fit.normals(mesh.V);
  EXPECT_EQ(fit.normals(mesh.V), N);
  EXPECT_EQ(fit.refit_count(), 0);
}

// The error of a fit that is kept grows with the square of the turn since it was made.
TEST(NormalFit, KeptFitsAreOfSecondOrderInTheTurn) {
  const samples::Mesh mesh =
      samples::lifted(samples::grid(12, 0.3), [](double x, double y) { return 0.2 * x * x - 0.1 * x * y; });
  const NormalFit fit(mesh.V, mesh.F);
  const auto error = [&](double slope) {
    Positions V = mesh.V;
    V.col(2) += slope * V.col(0);
    return (fit.kept_normals(V) - NormalFit(V, mesh.F).normals(V)).rowwise().norm().maxCoeff();
  };
  EXPECT_LT(error(0.0), 1e-14);
  EXPECT_LT(error(0.01), 1e-3);
  EXPECT_LT(error(0.01), 0.4 * error(0.02));
}

// As where all faces of a mesh are hidden.
TEST(NormalFit, NeedsNoTriangle) {
  const samples::Mesh mesh = samples::grid(2);
  NormalFit fit(mesh.V, Triangles(0, 3));
  EXPECT_EQ(fit.normals(mesh.V), Positions(Eigen::RowVector3d(0, 0, 1).replicate(mesh.V.rows(), 1)));
}

TEST(NormalFit, LooseVertexHasANormalToo) {
  samples::Mesh mesh = samples::grid(2);
  mesh.V.conservativeResize(10, 3);
  mesh.V.row(9) << 5, 5, 5;
  NormalFit fit(mesh.V, mesh.F);
  EXPECT_EQ(fit.normals(mesh.V).row(9), Eigen::RowVector3d(0, 0, 1));
}

}  // namespace
}  // namespace reflines
