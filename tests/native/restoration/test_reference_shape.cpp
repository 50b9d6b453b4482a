// Halves of a symmetric panel become alike, at its border too, but for what one of them has by design.
#include <gtest/gtest.h>

#include <cmath>

#include "restoration/reference_shape.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr double kLength = 0.1, kDent = 0.0006, kDeep = 0.004;

double dome(double x, double y) { return 0.1 * x * (1 - x) + 0.15 * y * y * (1 - y); }

double distance(double x, double y, double to_x, double to_y) { return std::hypot(x - to_x, y - to_y); }

// A recess with a floor, 0.12 wide, whose rim is 0.05 wide.
double recess(double x, double y) { return -0.5 * kDeep * (1 - std::tanh((distance(x, y, 0.7, 0.6) - 0.06) / 0.012)); }

double dent(double x, double y, double at_y) {
  return -kDent * std::exp(-std::pow(distance(x, y, 0.25, at_y) / 0.05, 2));
}

// The unit square, symmetric but for one height, seen from above; its border stays.
struct Panel {
  explicit Panel(const samples::Height& flaw)
      : mesh(samples::lifted(samples::grid(40), [&](double x, double y) { return dome(x, y) + flaw(x, y); })),
        field(samples::height_field(mesh)),
        surface(mesh.V, mesh.F, {0, 0, 1}, {{0, 1, 0.3}}, {std::vector<Border>(mesh.V.rows(), Border::kFixed)}),
        reference(even_halves(surface, field, field.z, kLength, false)) {}

  Vector average(const Vector& move) { return average_partners(surface, reference, move); }

  Vector measure(const samples::Height& height) const { return samples::lifted(mesh, height).V.col(2); }

  samples::Mesh mesh;
  HeightField field;
  MeshSurface surface;
  ReferenceShape reference;
};

TEST(ReferenceShape, TakesADentOfOneHalfOutWhereverItLies) {
  for (const double at_y : {0.5, 0.0}) {  // the border cuts the second in half, and its vertices are held
    const auto flaw = [&](double x, double y) { return dent(x, y, at_y); };
    const Panel panel(flaw);
    EXPECT_LT((panel.reference.correction + panel.measure(flaw)).cwiseAbs().maxCoeff(), 0.15 * kDent) << at_y;
  }
}

TEST(ReferenceShape, WhatOneHalfHasByDesignIsNotAveraged) {
  Panel panel(recess);
  ASSERT_FALSE(panel.reference.partners.empty());
  // Averaged, both sides got half of it: 0.5.
  const Vector still = Vector::Zero(panel.field.vertex_count());
  EXPECT_LT(panel.average(still).cwiseAbs().maxCoeff(), 0.01 * kDeep);
}

TEST(ReferenceShape, AMoveOfOneHalfBecomesHalfOfItOnBoth) {
  Panel panel([](double, double) { return 0.0; });
  const auto bump = [](double x, double y) { return dent(x, y, 0.4); };
  const auto both = [&](double x, double y) { return 0.5 * (bump(x, y) + bump(1 - x, y)); };
  EXPECT_LT((panel.average(panel.measure(bump)) - panel.measure(both)).cwiseAbs().maxCoeff(), 1e-3 * kDent);
}

}  // namespace
}  // namespace reflines
