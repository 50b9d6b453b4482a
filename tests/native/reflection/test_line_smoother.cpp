// Cancelling while the system of the smoothing is assembled, half a second of 250,000 vertices.
#include <gtest/gtest.h>

#include "reflection/line_smoother.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

double bowl(double x, double y) { return 0.3 * x * x + 0.25 * y * y; }

TEST(LineSmootherTest, IsCancelledBeforeItFactors) {
  const HeightField field = samples::height_field(samples::lifted(samples::grid(6), bowl));
  const Stencils stencils = make_stencils(field, StencilKind::kConsistent);
  const int n = field.triangle_count();
  int factorized = 0;
  const auto factorize = [&](const SparseMatrix&) -> SpdSolve {
    ++factorized;
    return [](Vector&) {};
  };
  const auto make = [&](const Progress* progress) {
    LineSmoother(field, stencils, {0.3, false}, PlaneVectors(0, 2), Vector::Ones(n), Mask::Constant(n, false),
                 factorize, progress);
  };
  Progress progress;
  make(&progress);
  make(nullptr);
  EXPECT_EQ(factorized, 2);
  progress.cancel();
  EXPECT_THROW(make(&progress), Cancelled);
  EXPECT_EQ(factorized, 2);
}

}  // namespace
}  // namespace reflines
