// The sampled energy: derivatives of its own, and for a smooth change nearly those of the energy it stands for.
#include <gtest/gtest.h>

#include <cmath>

#include "reflection/reflection_field.h"
#include "solver/coarse/sampled_energy.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

double dome(double x, double y) { return 0.4 * x * (1 - x) + 0.3 * y * (1 - y) + 0.1 * x * y; }

// An irregular dome that is asked for the lines of a flatter one, with a pull to where it is.
struct SampledEnergyTest : testing::Test {
  SampledEnergyTest()
      : field(samples::height_field(samples::lifted(samples::grid(48, 0.2), dome), Border::kClamped)),
        stencils(make_stencils(field, StencilKind::kConsistent)),
        energy(field, stencils, 2.0),
        modes(build_spline_basis(field, 6.0)) {
    const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
    const ReflectionFunction lines(frame, frame.z(), Vector3(0, 1, 0.3));
    TriangleDerivatives u;
    apply_stencils(stencils, 0.8 * field.z, u);
    energy.set_terms({{lines, reflection_field(lines, u).gradient, {}, field.area}});
  }
  Vector moved(const Vector& c) const {
    Vector z = field.z;
    Vector moves = Vector::Zero(modes.places.rows());
    modes.move(c, moves);
    for (int v = 0, k = 0; v < z.size(); ++v) {
      if (field.role[v] == VertexRole::kFree) z(v) += moves(k++);
    }
    return z;
  }

  HeightField field;
  Stencils stencils;
  Energy energy;
  SplineBasis modes;
};

TEST_F(SampledEnergyTest, GradientAndNewtonHessianAreItsDerivatives) {
  SampledEnergy sampled(field, energy, modes, field.z);
  const Vector c = 0.01 * Vector::LinSpaced(modes.count, -1.0, 1.0);
  Vector gradient(c.size()), plus(c.size()), minus(c.size());
  sampled.evaluate(c, &gradient);
  for (int k = 0; k < c.size(); k += 5) {
    const Vector h = 1e-5 * Vector::Unit(c.size(), k);
    const double difference = (sampled.evaluate(c + h, &plus) - sampled.evaluate(c - h, &minus)) / 2e-5;
    EXPECT_NEAR(gradient(k), difference, 1e-6 * gradient.norm());
    // Without residual to speak of along one column, Gauss-Newton is the derivative of the gradient up to its
    // curvature.
    const Eigen::MatrixXd H = sampled.hessian(c, HessianModel::kGaussNewton).toDense();
    const Eigen::MatrixXd whole = H.selfadjointView<Eigen::Lower>();
    EXPECT_LT(((plus - minus) / 2e-5 - whole.col(k)).norm(), 0.1 * whole.col(k).norm());
  }
}

// Cells without a motion hold no sample: their energy, which no motion changes, is left out.
TEST_F(SampledEnergyTest, ChangesAsTheEnergyDoesAlongSmoothMotions) {
  const SampledEnergy sampled(field, energy, modes, field.z);
  const Vector c = 0.01 * Vector::LinSpaced(modes.count, 0.0, 3.0).array().sin().matrix();
  const double whole = energy.evaluate(moved(c), nullptr) - energy.evaluate(field.z, nullptr);
  const double own = sampled.evaluate(c, nullptr) - sampled.evaluate(Vector::Zero(c.size()), nullptr);
  EXPECT_NEAR(own, whole, 0.1 * std::abs(whole));
}

}  // namespace
}  // namespace reflines
