// Quadratic surfaces have no variation of curvature, a fairing is a minimum, and smoothing keeps what is design.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/height_field.h"
#include "restoration/adaptive_smoother.h"
#include "restoration/curvature_variation.h"
#include "restoration/fairing_system.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr double kLength = 0.1;

double crown(double x, double y) { return -0.15 * x * x - 0.1 * y * y + 0.02 * x * y; }

HeightField make_field(double (*height)(double, double)) {
  return samples::height_field(samples::lifted(samples::grid(40, 0.1), height), Border::kClamped);
}

EdgeWeights equal_weights(const HeightField& field, double weight) {
  EdgeWeights result = EdgeWeights::Constant(field.triangle_count(), 3, weight);
  return (field.neighbors.array() < 0).select(0.0, result.array());
}

double rough(double x, double y) { return crown(x, y) + 0.001 * std::sin(40 * x) * std::sin(35 * y); }

double sphere(double x, double y) { return std::sqrt(1.0 - (x - 0.5) * (x - 0.5) - (y - 0.5) * (y - 0.5)); }

double flat(double x, double y) { return 0.3 * x - 0.2 * y; }

Vector measure_variation(const HeightField& shape, const Vector& z) {
  const CurvatureVariation variation(shape);
  const Eigen::MatrixXd tensor = variation.read_tensors(variation.average(variation.read_hessians(z)));
  return (tensor.col(0) + tensor.col(2)).cwiseSqrt();
}

TEST(CurvatureVariation, QuadraticHeightsOverAPlaneHaveNone) {
  const HeightField field = make_field(&flat);
  const CurvatureVariation variation(field);
  const Vector z = make_field(&crown).z;
  EXPECT_LT(measure_variation(make_field(&crown), z).maxCoeff(), 1e-6);  // that of the heights, on any surface
  const EdgeWeights scaled = variation.scale_by_shape(equal_weights(field, 1.0));
  const double rough_size = variation.differentiate(make_field(&rough).z, scaled).cwiseAbs().maxCoeff();
  EXPECT_LT(variation.differentiate(z, scaled).cwiseAbs().maxCoeff(), 1e-9 * rough_size);
}

double measure_energy(const HeightField& shape, const Vector& z) {
  const CurvatureVariation variation(shape);
  return z.dot(variation.differentiate(z, variation.scale_by_shape(equal_weights(shape, 1.0))));
}

// The second derivatives of a sphere's heights are 1 at its top and 2.8 where it slopes by 45 degrees; its forms are
// the same everywhere, but for the errors of the stencils, which are exact on quadratic heights.
TEST(CurvatureVariation, SpheresHaveHalfTheEnergyOfTheirHeights) {
  const HeightField field = make_field(&sphere);
  EXPECT_LT(measure_energy(field, field.z), 0.6 * measure_energy(make_field(&flat), field.z));
}

// At the minimum the gradients of the variation and of what keeps the heights cancel out.
TEST(FairingSystem, FindsTheMinimum) {
  const HeightField field = make_field(&rough);
  const CurvatureVariation variation(field);
  FairingSystem system(variation);
  const EdgeWeights weight = equal_weights(field, std::pow(kLength / 6.0, 6));
  system.factorize(weight, Vector::Zero(field.triangle_count()), nullptr);
  const Vector smoothed = system.smooth(field.z);
  Vector area = Vector::Zero(field.vertex_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) area(field.F(t, i)) += field.area(t) / 3.0;
  }
  const Vector change = smoothed - field.z;
  const Vector gradient =
      variation.differentiate(smoothed, variation.scale_by_shape(weight)) + area.cwiseProduct(change);
  const double size = area.cwiseProduct(change).cwiseAbs().maxCoeff();
  EXPECT_GT(change.cwiseAbs().maxCoeff(), 2e-4);
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kFree) {
      EXPECT_LT(std::abs(gradient(v)), 1e-6 * size);
    } else {
      EXPECT_EQ(change(v), 0.0);
    }
  }
}

TEST(AdaptiveSmoother, TakesRipplesOutAndLeavesAFoldAlone) {
  const HeightField ripples =
      make_field([](double x, double y) { return crown(x, y) + 2e-4 * std::sin(60 * x) * std::sin(55 * y); });
  const Vector smoothed = AdaptiveSmoother(ripples, kLength).adapt(ripples.z, nullptr);
  EXPECT_GT((smoothed - ripples.z).cwiseAbs().maxCoeff(), 1e-4);
  const HeightField fold = make_field([](double x, double y) { return crown(x, y) - 0.2 * std::abs(x - 0.5); });
  const Vector kept = AdaptiveSmoother(fold, kLength).adapt(fold.z, nullptr);
  EXPECT_LT((kept - fold.z).cwiseAbs().maxCoeff(), 0.002 * 0.1);  // its height
}

}  // namespace
}  // namespace reflines
