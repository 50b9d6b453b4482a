#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reflines/check_panel.h"
#include "reflines/errors.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

// The triangles of a mesh over the unit square whose centroids lie left of x = `end`.
Mask left_of(const samples::Mesh& mesh, double end) {
  Mask result(mesh.F.rows());
  for (int t = 0; t < mesh.F.rows(); ++t) {
    result(t) = (mesh.V(mesh.F(t, 0), 0) + mesh.V(mesh.F(t, 1), 0) + mesh.V(mesh.F(t, 2), 0)) / 3 < end;
  }
  return result;
}

const CheckRow& row_of(const PanelCheck& check, const std::string& name) {
  for (const CheckRow& row : check.rows) {
    if (row.name == name) return row;
  }
  throw InvalidInput("no such row");
}

PanelCheck check_shape(const samples::Mesh& mesh, const CheckOptions& options = {}) {
  return check_panel(mesh.V, mesh.V, mesh.F, left_of(mesh, 0.5), options);
}

double sphere(double x, double y) { return std::sqrt(4 - (x - 0.3) * (x - 0.3) - (y - 0.4) * (y - 0.4)); }

TEST(CheckPanel, ASmoothSurfaceHasNoSeamsHoweverItIsCut) {
  double coarse = 0;
  for (const int n : {16, 32}) {
    const PanelCheck check = check_shape(samples::lifted(samples::grid(n, 0.2), sphere));
    EXPECT_LT(row_of(check, "border angle").after, n == 16 ? 0.02 : 0.004);
    EXPECT_LT(row_of(check, "border curvature").after, n == 16 ? 2.0 : 0.5);
    if (n == 32) EXPECT_LT(row_of(check, "border curvature").after, 0.35 * coarse);  // second order
    coarse = row_of(check, "border curvature").after;
    EXPECT_TRUE(check.all_pass());
  }
}

TEST(CheckPanel, TwoPlanesMeetAtTheirAngle) {
  const double slope = std::tan(3 * std::numbers::pi / 180);
  const auto mesh =
      samples::lifted(samples::grid(12), [&](double x, double) { return x < 0.5 ? 0 : slope * (x - 0.5); });
  const PanelCheck check = check_shape(mesh);
  int borders = 0;
  for (int k = 0; k < check.edges.rows(); ++k) {
    if (check.kind[k] != SeamKind::kBorder) continue;
    ++borders;
    EXPECT_NEAR(check.after.angle(k), 3, 1e-9);
    EXPECT_FALSE(check.passes(k));
  }
  EXPECT_EQ(borders, 12);
  EXPECT_EQ(check.edges.rows(), 12 + 24);  // the others are open
  EXPECT_FALSE(row_of(check, "border angle").passes);
  EXPECT_NEAR(row_of(check, "border angle").place.x(), 0.5, 1e-12);
}

TEST(CheckPanel, ATangentArcDiffersInCurvatureOnly) {
  constexpr double kRadius = 4;
  const auto mesh = samples::lifted(samples::grid(24, 0.0), [&](double x, double) {
    return x < 0.5 ? 0 : std::sqrt(kRadius * kRadius - (x - 0.5) * (x - 0.5)) - kRadius;
  });
  const PanelCheck check = check_shape(mesh);
  EXPECT_LT(row_of(check, "border angle").after, 1e-3);
  EXPECT_NEAR(row_of(check, "border curvature").after, 100, 1);
  EXPECT_TRUE(row_of(check, "border angle").passes);
  EXPECT_FALSE(row_of(check, "border curvature").passes);
}

TEST(CheckPanel, ACreaseIsJudgedByItsChange) {
  const auto roof = [](double slope) {
    return samples::lifted(samples::grid(16), [=](double x, double) { return -slope * std::abs(x - 0.25); });
  };
  const samples::Mesh before = roof(0.4), after = roof(0.41);
  const PanelCheck same = check_panel(before.V, before.V, before.F, left_of(before, 0.5));
  EXPECT_NEAR(row_of(same, "crease angle").after, 2 * std::atan(0.4) * 180 / std::numbers::pi, 1e-6);
  EXPECT_TRUE(row_of(same, "crease angle").passes);
  EXPECT_FALSE(row_of(check_panel(before.V, after.V, before.F, left_of(before, 0.5)), "crease angle").passes);
  EXPECT_THROW(row_of(check_panel(before.V, after.V, before.F, left_of(before, 0.5), {.creases = {CreaseRule::kNone}}),
                      "crease angle"),
               InvalidInput);
}

// The left half of the grid moved down by a gap, so that the sheets are no longer joined.
samples::Mesh parted(double gap) {
  samples::Mesh mesh = samples::grid(8);
  const Mask left = left_of(mesh, 0.5);
  const int n = static_cast<int>(mesh.V.rows());
  mesh.V.conservativeResize(2 * n, 3);
  mesh.V.bottomRows(n) = mesh.V.topRows(n);
  mesh.V.bottomRows(n).col(2).array() -= gap;
  for (int t = 0; t < mesh.F.rows(); ++t) {
    if (left(t)) mesh.F.row(t).array() += n;
  }
  return mesh;
}

TEST(CheckPanel, TheGapToASheetBesideIsMeasuredWithinReach) {
  const PanelCheck near = check_shape(parted(0.001));
  EXPECT_NEAR(row_of(near, "border gap").after, 0.001, 1e-12);
  EXPECT_FALSE(row_of(near, "border gap").passes);
  EXPECT_TRUE(row_of(check_shape(parted(0.001), {.gap = 0.002}), "border gap").passes);
  const PanelCheck far = check_shape(parted(0.02));  // an edge is 0.125 long
  for (const SeamKind kind : far.kind) EXPECT_EQ(kind, SeamKind::kOpen);
}

TEST(CheckPanel, DeviationIsTheDistanceFromTheSurfaceBefore) {
  const samples::Mesh mesh = samples::grid(10);
  samples::Mesh slid = mesh, lifted = mesh;
  const int inner = 5 * 11 + 3;
  slid.V.row(inner) += Eigen::RowVector3d(0.01, 0.02, 0);
  lifted.V(inner, 2) += 0.03;
  EXPECT_LT(check_panel(mesh.V, slid.V, mesh.F, left_of(mesh, 0.5)).largest_deviation, 1e-15);
  const PanelCheck check = check_panel(mesh.V, lifted.V, mesh.F, left_of(mesh, 0.5), {.deviation = 0.02});
  EXPECT_DOUBLE_EQ(check.largest_deviation, 0.03);
  EXPECT_EQ(check.deviation_95, 0);  // one vertex of 66
  EXPECT_DOUBLE_EQ(check.deviation(inner), 0.03);
  EXPECT_FALSE(row_of(check, "deviation").passes);
}

}  // namespace
}  // namespace reflines
