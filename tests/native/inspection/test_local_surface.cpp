#include <gtest/gtest.h>

#include <cmath>

#include "inspection/local_surface.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

double quartic(double x, double y) {
  return 0.2 * x * x - 0.1 * x * y * y + 0.05 * x * x * y * y - 0.1 * y * y * y * y;
}

HeightField make_field(const samples::Mesh& mesh) {
  const ImagePlane frame(Vector3::UnitZ(), Vector3::UnitX());
  const Boundary boundary{std::vector<Border>(mesh.V.rows(), Border::kFree), {}, {.rule = CreaseRule::kNone}};
  return make_height_field(mesh.V, mesh.F, frame, boundary);
}

TEST(LocalSurface, AQuarticKeepsItsHeightsUpToTheBorder) {
  const HeightField field = make_field(samples::lifted(samples::grid(24, 0.3), quartic));
  EXPECT_LT((fit_local_surface(field, 0.3, nullptr) - field.z).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(LocalSurface, ADentIsNoPartOfIt) {
  const auto dent = [](double x, double y) {
    return 1e-3 * std::exp(-((x - 0.4) * (x - 0.4) + (y - 0.6) * (y - 0.6)) / 0.0025);
  };
  const auto dented = [&](double x, double y) { return quartic(x, y) + dent(x, y); };
  const samples::Mesh mesh = samples::lifted(samples::grid(60, 0.2), dented);
  const HeightField field = make_field(mesh);
  const Vector flaw = field.z - fit_local_surface(field, 0.3, nullptr);
  for (int v = 0; v < field.vertex_count(); ++v) EXPECT_NEAR(flaw(v), dent(mesh.V(v, 0), mesh.V(v, 1)), 1e-4);
}

TEST(LocalSurface, TooFewVerticesTellNothing) {
  const HeightField field = make_field(samples::lifted(samples::grid(2), quartic));
  EXPECT_EQ(fit_local_surface(field, 10, nullptr), field.z);
}

}  // namespace
}  // namespace reflines
