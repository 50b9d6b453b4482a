// What an optimizer is refused for before it computes anything.
#include <gtest/gtest.h>

#include <limits>

#include "reflines/errors.h"
#include "reflines/shape_optimizer.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

void build(const Vector& shares) {
  samples::Mesh mesh = samples::grid(4, 0.0);
  mesh.V.col(2) = -0.2 * mesh.V.col(0).array().square();
  ShapeOptions options;
  options.quadrature_weight = shares;
  const ShapeOptimizer optimizer(mesh.V, mesh.F, Vector3::UnitZ(), {Vector3(1, 0.2, 0.4)}, options);
}

TEST(SolveChecks, SharesOfTheEnergyAreOneForEachTriangleOrNone) {
  const int triangles = static_cast<int>(samples::grid(4, 0.0).F.rows());
  EXPECT_NO_THROW(build(Vector()));
  EXPECT_NO_THROW(build(Vector::Ones(triangles)));
  for (const int count : {1, 3, triangles - 1, triangles + 1}) EXPECT_THROW(build(Vector::Ones(count)), InvalidInput);
}

TEST(SolveChecks, SharesOfTheEnergyAreNumbersFromZeroOn) {
  Vector shares = Vector::Ones(samples::grid(4, 0.0).F.rows());
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    shares(2) = wrong;
    EXPECT_THROW(build(shares), InvalidInput);
  }
}

}  // namespace
}  // namespace reflines
