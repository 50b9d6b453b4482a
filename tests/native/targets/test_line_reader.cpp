#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "targets/line_reader.h"

namespace reflines {
namespace {

double turn(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

// It passes pi within the triangle: at the corners it is 2.69, 4.20 (thus -2.08) and 2.37.
double theta(const Vector2& p) {
  return 2.8 + 0.6 * p.x() - 0.9 * p.y() + 0.8 * p.x() * p.x() - 1.1 * p.x() * p.y() + 0.5 * p.y() * p.y();
}

RegionField one_triangle() {
  RegionField field;
  field.xy.resize(3, 2);
  field.xy << 0.1, 0.2, 1.0, 0.0, 0.4, 0.9;
  field.F.resize(1, 3);
  field.F << 0, 1, 2;
  field.vertex_theta.resize(3);
  field.vertex_gradient.resize(3, 2);
  for (int v = 0; v < 3; ++v) {
    const double x = field.xy(v, 0), y = field.xy(v, 1);
    field.vertex_theta(v) = turn(theta(field.xy.row(v)));
    field.vertex_gradient.row(v) << 0.6 + 1.6 * x - 1.1 * y, -0.9 - 1.1 * x + y;
  }
  return field;
}

// The error is thus of third order; that of values interpolated without their gradients is of second.
TEST(LineReader, IsExactWhereThetaIsQuadratic) {
  const RegionField field = one_triangle();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(0, 1);
  for (int k = 0; k < 100; ++k) {
    Vector3 share(any(random), any(random), any(random));
    share /= share.sum();
    const Vector2 point = field.xy.transpose() * share;
    const double reference = 20 * any(random) - 10;
    const double read = evaluate_theta_near(field, {0, share}, point, reference);
    EXPECT_LE(std::abs(read), std::numbers::pi);
    EXPECT_NEAR(turn(read + reference - theta(point)), 0, 1e-14 * 20);
  }
}

}  // namespace
}  // namespace reflines
