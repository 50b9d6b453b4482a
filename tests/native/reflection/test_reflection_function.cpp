#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "reflection/reflection_function.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

class Reflection : public ::testing::Test {
 protected:
  Vector3 direction() { return Vector3(normal_(random_), normal_(random_), normal_(random_)).normalized(); }
  double slope() { return 0.8 * normal_(random_); }

  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

// Eq. 1 as printed: reflect v in the normal, project along a, measure from v_a.
double equation_one(const Vector3& n, const Vector3& v, const Vector3& a) {
  const Vector3 r = (2 / n.squaredNorm()) * n.dot(v) * n - v;
  const Vector3 v_a = (v - v.dot(a) * a).normalized();
  const Vector3 a_perp = a.cross(v_a);
  return std::atan2(r.dot(a_perp), r.dot(v_a));
}

double turn(double angle) { return std::abs(std::remainder(angle, 2 * std::numbers::pi)); }

TEST_F(Reflection, AgreesWithEquationOneInSpace) {
  for (int k = 0; k < 2000; ++k) {
    const Vector3 v = direction(), a = direction();
    if (v.cross(a).norm() < 0.05) continue;
    const ImagePlane frame(v, a);
    const double p = slope(), q = slope();
    const Vector3 n = -p * frame.x() - q * frame.y() + frame.z();
    const ReflectionFunction reflection(frame, v, a);
    if (reflection.visibility(p, q) < 1e-2) continue;  // theta itself is ill conditioned at its pole
    EXPECT_LT(turn(reflection.theta(p, q) - equation_one(n, v, a)), 1e-12);
  }
}

TEST_F(Reflection, AgreesWithTheCoordinateFormWithTrueNormals) {
  const ImagePlane frame(Vector3(0, 0, 1), Vector3(0, std::cos(0.35), std::sin(0.35)));
  const ReflectionFunction reflection(frame, Vector3(0, 0, 1), Vector3(0, std::cos(0.35), std::sin(0.35)));
  for (int k = 0; k < 100; ++k) {
    const double p = slope(), q = slope();
    const double expected = std::atan2(-2 * p, std::cos(0.35) * (1 - p * p - q * q) + 2 * std::sin(0.35) * q);
    EXPECT_LT(turn(reflection.theta(p, q) - expected), 1e-12);
  }
}

TEST_F(Reflection, AnotherFamilyInTheSameFrameIsEquationOneToo) {
  const Vector3 v(0.2, -0.1, 0.9), a(1, 0.2, 0.1), b(-0.3, 1, 0.4);
  const ImagePlane frame(v, a);
  const ReflectionFunction reflection(frame, v, b);
  for (int k = 0; k < 100; ++k) {
    const double p = slope(), q = slope();
    const Vector3 n = -p * frame.x() - q * frame.y() + frame.z();
    EXPECT_LT(turn(reflection.theta(p, q) - equation_one(n, v.normalized(), b.normalized())), 1e-12);
  }
}

TEST_F(Reflection, AFamilyWithItsOwnEyeIsEquationOneToo) {
  for (int k = 0; k < 500; ++k) {
    const Vector3 v = direction(), a = direction(), eye = direction(), b = direction();
    if (v.cross(a).norm() < 0.05 || eye.cross(b).norm() < 0.05) continue;
    const ImagePlane frame(v, a);
    const double p = slope(), q = slope();
    const Vector3 n = -p * frame.x() - q * frame.y() + frame.z();
    const ReflectionFunction reflection(frame, eye, b);
    if (reflection.visibility(p, q) < 1e-2) continue;
    EXPECT_LT(turn(reflection.theta(p, q) - equation_one(n, eye, b)), 1e-12);
  }
}

TEST_F(Reflection, VisibilityIsTheSineBetweenTheReflectedRayAndTheLines) {
  for (int k = 0; k < 2000; ++k) {
    const Vector3 v = direction(), a = direction();
    if (v.cross(a).norm() < 0.05) continue;
    const ImagePlane frame(v, a);
    const double steep = std::pow(10.0, k % 4);
    const double p = steep * slope(), q = steep * slope();
    const Vector3 n = (-p * frame.x() - q * frame.y() + frame.z()).normalized();
    const Vector3 ray = 2 * n.dot(v) * n - v;
    const double visibility = ReflectionFunction(frame, v, a).visibility(p, q);
    EXPECT_NEAR(visibility, ray.cross(a).norm(), 1e-13);
    EXPECT_LE(visibility, 1 + 1e-13);
  }
}

TEST_F(Reflection, DerivativesAgreeWithCentralDifferences) {
  const ImagePlane frame(Vector3(0, 0, 1), Vector3(0.3, 1, 0.4));
  const ReflectionFunction reflection(frame, frame.z(), Vector3(0.3, 1, 0.4));
  const double h = 1e-5;  // error: h^2 / 6 of the next derivatives (some 1e2) + rounding 1e-16 / h
  for (int k = 0; k < 200; ++k) {
    const double p = 0.5 * slope(), q = 0.5 * slope();
    if (reflection.visibility(p, q) < 0.2) continue;
    const ThetaDerivatives d = reflection.derivatives(p, q, 3);
    const auto p1 = reflection.derivatives(p + h, q, 2), p0 = reflection.derivatives(p - h, q, 2);
    const auto q1 = reflection.derivatives(p, q + h, 2), q0 = reflection.derivatives(p, q - h, 2);
    const double tolerance = 1e-7;
    EXPECT_NEAR(d.p,
                std::remainder(reflection.theta(p + h, q) - reflection.theta(p - h, q), 2 * std::numbers::pi) / (2 * h),
                tolerance);
    EXPECT_NEAR(d.q,
                std::remainder(reflection.theta(p, q + h) - reflection.theta(p, q - h), 2 * std::numbers::pi) / (2 * h),
                tolerance);
    EXPECT_NEAR(d.pp, (p1.p - p0.p) / (2 * h), tolerance * (1 + std::abs(d.pp)));
    EXPECT_NEAR(d.pq, (q1.p - q0.p) / (2 * h), tolerance * (1 + std::abs(d.pq)));
    EXPECT_NEAR(d.qq, (q1.q - q0.q) / (2 * h), tolerance * (1 + std::abs(d.qq)));
    EXPECT_NEAR(d.ppp, (p1.pp - p0.pp) / (2 * h), 10 * tolerance * (1 + std::abs(d.ppp)));
    EXPECT_NEAR(d.ppq, (q1.pp - q0.pp) / (2 * h), 10 * tolerance * (1 + std::abs(d.ppq)));
    EXPECT_NEAR(d.pqq, (p1.qq - p0.qq) / (2 * h), 10 * tolerance * (1 + std::abs(d.pqq)));
    EXPECT_NEAR(d.qqq, (q1.qq - q0.qq) / (2 * h), 10 * tolerance * (1 + std::abs(d.qqq)));
  }
}

TEST_F(Reflection, IsFiniteWhereThetaIsUndefined) {
  // Flat surface tilted so that the reflected ray runs along the lines: r1 = r2 = 0.
  const Vector3 v(0, 0, 1), a(0, 1, 0);
  const ImagePlane frame(v, a);
  const ReflectionFunction reflection(frame, v, a);
  EXPECT_NEAR(reflection.visibility(0, 1), 0, 1e-15);
  const ThetaDerivatives d = reflection.derivatives(0, 1, 3);
  EXPECT_TRUE(std::isfinite(d.p) && std::isfinite(d.pp) && std::isfinite(d.qqq));
}

TEST_F(Reflection, RefusesLinesParallelToTheView) {
  EXPECT_THROW(ImagePlane(Vector3(0, 0, 1), Vector3(0, 0, -2)), InvalidInput);
  EXPECT_THROW(ImagePlane(Vector3(0, 0, 0), Vector3(0, 1, 0)), InvalidInput);
}

}  // namespace
}  // namespace reflines
