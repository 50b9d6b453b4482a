#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "reflection/energy.h"
#include "reflection/hessian_assembly.h"
#include "reflection/reflection_field.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

double bowl(double x, double y) { return 0.3 * x * x - 0.2 * x * y + 0.25 * y * y + 0.1 * std::sin(3 * x + 2 * y); }

// A small irregular surface with random wanted gradients in two families, the second of which has an eye of its own,
// and a value fit: every kind of term at once.
class EnergyTest : public ::testing::Test {
 protected:
  EnergyTest()
      : field_(samples::height_field(samples::lifted(samples::grid_with_valence_three(4, 5), bowl))),
        stencils_(make_stencils(field_, StencilKind::kConsistent)),
        energy_(field_, stencils_, 1e-2) {
    const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
    std::vector<EnergyTerm> terms;
    const Vector3 lines[] = {{0, 1, 0.3}, {1, 0.2, 0}}, eyes[] = {frame.z(), {-0.4, 0.5, 1}};
    for (int k = 0; k < 2; ++k) {
      const PlaneVectors wanted = PlaneVectors::Random(field_.triangle_count(), 2);
      terms.push_back({ReflectionFunction(frame, eyes[k], lines[k]), wanted, {}, field_.area});
    }
    terms.push_back({terms[0].reflection, {}, Vector::Random(field_.triangle_count()), 5 * field_.area});
    energy_.set_terms(terms);
    z_ = field_.z + 0.01 * Vector::Random(field_.vertex_count());
  }

  SparseMatrix hessian(HessianModel model) {
    std::vector<int> column(field_.vertex_count());
    for (size_t v = 0; v < column.size(); ++v) column[v] = static_cast<int>(v);
    HessianAssembly assembly(stencils_, energy_.entries(), column, field_.vertex_count());
    return assembly.assemble(energy_.element_hessians(z_, model), energy_.proximity_hessian());
  }

  HeightField field_;
  Stencils stencils_;
  Energy energy_;
  Vector z_;
};

TEST_F(EnergyTest, GradientAgreesWithCentralDifferences) {
  Vector gradient, nothing;
  const double E = energy_.evaluate(z_, &gradient);
  const double h = 1e-6;
  for (int v = 0; v < z_.size(); v += 3) {
    Vector plus = z_, minus = z_;
    plus(v) += h;
    minus(v) -= h;
    const double difference = (energy_.evaluate(plus, nullptr) - energy_.evaluate(minus, nullptr)) / (2 * h);
    // Truncation h^2 / 6 E''' and rounding eps E / h. One height moves curvatures by 1 / spacing^2 (16), so derivatives
    // of order k grow like 16^k E: 1e-12 * 4096 E + 1e-16 E / 1e-6.
    EXPECT_NEAR(gradient(v), difference, 1e-8 * E + 1e-7 * gradient.norm());
  }
}

TEST_F(EnergyTest, FullHessianBeforeProjectionAgreesWithCentralDifferencesOfTheGradient) {
  // Projection is switched off by looking where it does nothing: at the target itself full and Gauss-Newton Hessian
  // agree.
  TriangleDerivatives u;
  apply_stencils(stencils_, z_, u);
  const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
  const ReflectionFunction reflection(frame, frame.z(), Vector3(0, 1, 0.3));
  const ReflectionField own = reflection_field(reflection, u);
  energy_.set_terms({{reflection, own.gradient, {}, field_.area}, {reflection, {}, own.theta, field_.area}});
  const Eigen::MatrixXd H = Eigen::MatrixXd(hessian(HessianModel::kNewton)).selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd GN = Eigen::MatrixXd(hessian(HessianModel::kGaussNewton)).selfadjointView<Eigen::Lower>();
  EXPECT_LT((H - GN).norm(), 1e-9 * H.norm());
  const double h = 1e-6;
  for (int v = 0; v < z_.size(); v += 4) {
    Vector plus = z_, minus = z_, g1, g0;
    plus(v) += h;
    minus(v) -= h;
    energy_.evaluate(plus, &g1);
    energy_.evaluate(minus, &g0);
    EXPECT_LT(((g1 - g0) / (2 * h) - H.col(v)).norm(), 1e-6 * H.norm());  // h^2 / 6 g''' + eps |g| / h, as above
  }
}

TEST_F(EnergyTest, ElementHessiansAgreeWithCentralDifferences) {
  const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
  const ReflectionFunction reflection(frame, frame.z(), Vector3(0.2, 1, 0.3));
  const double h = 1e-5;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 50; ++k) {
    Vector5 u;
    u << 0.3 * normal(random), 0.3 * normal(random), normal(random), normal(random), normal(random);
    if (reflection.visibility(u(0), u(1)) < 0.3) continue;
    const Vector2 wanted(normal(random), normal(random));
    const Matrix5 M = gradient_fit_hessian(reflection, u, wanted, 1.5, HessianModel::kNewton);
    const Matrix5 N = value_fit_hessian(reflection, u, 0.7, 1.5, HessianModel::kNewton);
    for (int i = 0; i < 5; ++i) {
      Vector5 plus = u, minus = u, g1 = Vector5::Zero(), g0 = g1, s1 = g1, s0 = g1;
      plus(i) += h;
      minus(i) -= h;
      gradient_fit(reflection, plus, wanted, 1.5, &g1);
      gradient_fit(reflection, minus, wanted, 1.5, &g0);
      value_fit(reflection, plus, 0.7, 1.5, &s1);
      value_fit(reflection, minus, 0.7, 1.5, &s0);
      EXPECT_LT(((g1 - g0) / (2 * h) - M.col(i)).norm(), 1e-6 * (1 + M.norm()));
      EXPECT_LT(((s1 - s0) / (2 * h) - N.col(i)).norm(), 1e-6 * (1 + N.norm()));
    }
  }
}

TEST_F(EnergyTest, EveryModelIsPositiveSemiDefinite) {
  for (HessianModel model : {HessianModel::kLinearized, HessianModel::kGaussNewton, HessianModel::kNewton}) {
    const Eigen::MatrixXd H = Eigen::MatrixXd(hessian(model)).selfadjointView<Eigen::Lower>();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(H);
    EXPECT_GT(eigen.eigenvalues()(0), -1e-12 * eigen.eigenvalues().maxCoeff());
  }
}

TEST_F(EnergyTest, LinearizedModelDoesNotDependOnTheHeights) {
  const Eigen::MatrixXd before = hessian(HessianModel::kLinearized);
  z_.setRandom();
  const Eigen::MatrixXd after = hessian(HessianModel::kLinearized);
  EXPECT_EQ(before, after);
}

TEST_F(EnergyTest, AssemblyOverFreeVerticesIsTheSubmatrix) {
  const Eigen::MatrixXd all = Eigen::MatrixXd(hessian(HessianModel::kGaussNewton)).selfadjointView<Eigen::Lower>();
  std::vector<int> column(field_.vertex_count(), -1), vertex;
  for (int v = 0; v < field_.vertex_count(); ++v) {
    if (field_.role[v] != VertexRole::kFree) continue;
    column[v] = static_cast<int>(vertex.size());
    vertex.push_back(v);
  }
  HessianAssembly assembly(stencils_, energy_.entries(), column, static_cast<int>(vertex.size()));
  const SparseMatrix& lower =
      assembly.assemble(energy_.element_hessians(z_, HessianModel::kGaussNewton), energy_.proximity_hessian());
  const Eigen::MatrixXd part = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  for (size_t i = 0; i < vertex.size(); ++i) {
    for (size_t j = 0; j < vertex.size(); ++j) EXPECT_NEAR(part(i, j), all(vertex[i], vertex[j]), 1e-12 * all.norm());
  }
}

// A unit square of 2 x 2 cells in another unit, its middle lifted by half a side: the six triangles around it have
// three quarters of the area, a third of which is the middle's, and the diagonal is the root of two.
TEST(EnergyUnits, NeitherThePullNorTheFitDependsOnTheUnitOfLength) {
  const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
  double fit[2];
  for (const double unit : {1.0, 1000.0}) {
    samples::Mesh mesh = samples::grid(2);
    mesh.V *= unit;
    const HeightField field = samples::height_field(mesh);
    const Stencils stencils = make_stencils(field, StencilKind::kConsistent);
    Energy energy(field, stencils, 0.8);
    Vector z = field.z;
    z(4) += 0.5 * unit;
    const double pull = energy.evaluate(z, nullptr);
    EXPECT_NEAR(pull, 0.8 * (0.5 * 0.5) * (0.75 / 3) / 4, 1e-15);
    const PlaneVectors still = PlaneVectors::Zero(field.triangle_count(), 2);
    energy.set_terms({{ReflectionFunction(frame, frame.z(), Vector3(0, 1, 0.3)), still, {}, field.area}});
    fit[unit > 1] = energy.evaluate(z, nullptr) - pull;
  }
  EXPECT_GT(fit[0], 1);
  EXPECT_NEAR(fit[1], fit[0], 1e-13 * fit[0]);
}

TEST_F(EnergyTest, OwnFieldAsTargetIsZeroAndStationary) {
  TriangleDerivatives u;
  apply_stencils(stencils_, field_.z, u);
  const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitY());
  const ReflectionFunction reflection(frame, frame.z(), Vector3(0, 1, 0.3));
  energy_.set_terms({{reflection, reflection_field(reflection, u).gradient, {}, field_.area}});
  Vector gradient;
  EXPECT_EQ(energy_.evaluate(field_.z, &gradient), 0.0);
  EXPECT_EQ(gradient.norm(), 0.0);
}

}  // namespace
}  // namespace reflines
