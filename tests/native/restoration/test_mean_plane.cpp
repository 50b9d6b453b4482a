// Over the plane of its mean normal a surface that is seen at an angle is as large as it is.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/height_field.h"
#include "restoration/mean_plane.h"
#include "restoration/triangle_slopes.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

const Vector2 kSlope(1.2, -0.7);

double tilted(double x, double y) { return kSlope.x() * x + kSlope.y() * y; }

double bowed(double x, double y) { return tilted(x, y) + 0.3 * x * (1 - x) * y * (1 - y); }

HeightField make_field(double (*height)(double, double)) {
  return samples::height_field(samples::lifted(samples::grid(12, 0.1), height), Border::kFree);
}

TEST(MeanPlane, KeepsTheLengthsOfAPlane) {
  const HeightField field = make_field(&tilted), over = MeanPlane(field).project(field);
  EXPECT_LT(over.z.cwiseAbs().maxCoeff(), 1e-14);
  for (int t = 0; t < field.triangle_count(); ++t) {
    const int a = field.F(t, 0), b = field.F(t, 1);
    const double length = std::hypot((field.xy.row(a) - field.xy.row(b)).norm(), field.z(a) - field.z(b));
    EXPECT_NEAR((over.xy.row(a) - over.xy.row(b)).norm(), length, 1e-14);
  }
}

// What is within the border does not turn the plane.
TEST(MeanPlane, IsThatOfTheBorder) {
  const HeightField field = make_field(&bowed), over = MeanPlane(field).project(field);
  EXPECT_LT((over.xy - MeanPlane(make_field(&tilted)).project(make_field(&tilted)).xy).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_GT(over.z.maxCoeff() - over.z.minCoeff(), 0.01);
}

TEST(MeanPlane, ChangesOfHeightReturn) {
  const HeightField field = make_field(&bowed);
  const MeanPlane plane(field);
  const HeightField over = plane.project(field);
  const Vector moved = field.z + Vector::LinSpaced(field.vertex_count(), -0.1, 0.2);
  const Vector returned = field.z + plane.change_along_view(plane.project_heights(moved, over.xy) - over.z);
  EXPECT_LT((returned - moved).cwiseAbs().maxCoeff(), 1e-14);
}

// Edges of the surface are as long in the tangent plane, and the normal distance of two heights is a share of theirs.
TEST(MeanPlane, MapsToTheTangentPlane) {
  const HeightField field = make_field(&bowed);
  const MeanPlane plane(field);
  const HeightField over = plane.project(field);
  const PlaneVectors slope = find_slopes(over.xy, over.F, over.z), in_view = find_slopes(field.xy, field.F, field.z);
  for (int t = 0; t < field.triangle_count(); ++t) {
    const TangentMap map = plane.map_to_tangent(slope.row(t));
    const int a = field.F(t, 0), b = field.F(t, 1);
    const double length = std::hypot((field.xy.row(a) - field.xy.row(b)).norm(), field.z(a) - field.z(b));
    EXPECT_NEAR((map.stretch * (over.xy.row(a) - over.xy.row(b)).transpose()).norm(), length, 1e-13);
    EXPECT_NEAR(map.lift * plane.project_heights(Vector::Ones(1), PlanePositions::Zero(1, 2))(0),
                1.0 / std::sqrt(1.0 + in_view.row(t).squaredNorm()), 1e-13);
  }
}

TEST(Substitute, TurnsHessiansIntoThoseOfTheSubstitutedFunction) {
  Eigen::Matrix2d A;
  A << 1.3, 0.4, -0.2, 0.8;
  const Eigen::RowVector3d hessian(2.0, std::sqrt(2.0) * 0.5, -1.0);  // of x^2 + xy / 2 - y^2 / 2
  const auto f = [](const Vector2& p) { return p.x() * p.x() + 0.5 * p.x() * p.y() - 0.5 * p.y() * p.y(); };
  const Eigen::RowVector3d found = hessian * substitute(A);
  const Vector2 q(0.7, -0.3);
  EXPECT_NEAR(0.5 * (found(0) * q.x() * q.x() + std::sqrt(2.0) * found(1) * q.x() * q.y() + found(2) * q.y() * q.y()),
              f(A * q), 1e-14);
}

}  // namespace
}  // namespace reflines
