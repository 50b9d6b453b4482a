#include <gtest/gtest.h>

#include "restoration/even_places.h"
#include "restoration/press_rules.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

// A dome of 30 x 30 cells whose lines become less even in its left quarter, in the second light, and more even on the
// right.
struct Panel {
  samples::Mesh mesh =
      samples::lifted(samples::grid(30), [](double x, double y) { return 0.1 * (x * (1 - x) + y * (1 - y)); });
  MeshSurface surface{mesh.V, mesh.F, {0, 0, 1}, {{1, 0, 0}, {0, 1, 0}}, {}};
  Eigen::MatrixXd before = Eigen::MatrixXd::Constant(mesh.F.rows(), 2, 4.0);
  Eigen::MatrixXd after = before;

  Panel() {
    for (int t = 0; t < mesh.F.rows(); ++t) {
      const double x = mesh.V(mesh.F(t, 0), 0);
      after.row(t) << 1.0, x < 0.25 ? 12.0 : 1.0;
    }
  }
};

TEST(EvenPlaces, StayWhereALightBecomesLessEvenAndAreHealedElsewhere) {
  Panel panel;
  constexpr double kLength = 0.1;
  const Vector share = find_even_places(panel.surface, panel.before, panel.after, kLength, kRules.verdict.raised, {});
  ASSERT_EQ(share.size(), panel.mesh.V.rows());
  for (int v = 0; v < share.size(); ++v) {
    const double x = panel.mesh.V(v, 0);
    EXPECT_GE(share(v), 0.0);
    EXPECT_LE(share(v), 1.0 + 1e-12);
    if (x < 0.25 - 1.5 * kLength) EXPECT_NEAR(share(v), 0.0, 1e-12) << x;
    if (x > 0.25 + 1.5 * kLength) EXPECT_NEAR(share(v), 1.0, 1e-12) << x;
  }
}

// A share falls from 1 to 0 over several triangles: no edge is made.
TEST(EvenPlaces, HaveSmoothBorders) {
  Panel panel;
  const Vector share = find_even_places(panel.surface, panel.before, panel.after, 0.2, kRules.verdict.raised, {});
  for (int t = 0; t < panel.mesh.F.rows(); ++t) {
    for (int i = 0; i < 3; ++i)
      EXPECT_LT(std::abs(share(panel.mesh.F(t, i)) - share(panel.mesh.F(t, (i + 1) % 3))), 0.4);
  }
}

TEST(EvenPlaces, AreTheSameOfMirrorImages) {
  Panel panel;
  IndexVector partner = IndexVector::Constant(panel.mesh.V.rows(), -1);
  partner(0) = static_cast<int>(partner.size()) - 1;
  partner(partner.size() - 1) = 0;
  const Vector share = find_even_places(panel.surface, panel.before, panel.after, 0.1, kRules.verdict.raised, partner);
  EXPECT_EQ(share(0), share(share.size() - 1));
  EXPECT_NEAR(share(0), 0.0, 1e-12);
}

}  // namespace
}  // namespace reflines
