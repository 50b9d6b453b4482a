// The pull that continues the curvature of the surroundings: it ends at creases, and where lines bend strongly.
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/border_curvature.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr int kCells = 20;
constexpr double kFold = 0.15;
const CreaseOptions kNoCreases{.rule = CreaseRule::kNone};  // none is held, so that what ends the pull is its own
constexpr double kCalm = 1e6;                               // a size of strong bends that no line here comes near

double dome(double x, double y) { return 0.1 * x * (1 - x) + 0.15 * y * (1 - y); }

double folded(double x, double y) { return dome(x, y) - 0.6 * std::max(x - kFold, 0.0); }

// The unit square as a region whose border at x = 0 has the curvature of four columns of cells beyond it.
struct Panel {
  explicit Panel(const samples::Height& height, double jitter = 0.0)
      : mesh(samples::lifted(samples::grid(kCells, jitter), height)) {
    Boundary boundary{std::vector<Border>(mesh.V.rows(), Border::kFixed)};
    boundary.creases = kNoCreases;
    field = make_height_field(mesh.V, mesh.F, frame, boundary);
    const int row = kCells + 1, count = static_cast<int>(mesh.V.rows());
    beside.V.resize(4 * row, 3);
    for (int v = 0; v < beside.V.rows(); ++v) {
      const double x = -(v / row + 1.0) / kCells, y = static_cast<double>(v % row) / kCells;
      beside.V.row(v) << x, y, height(x, y);
    }
    beside.F.resize(8 * kCells, 3);
    const auto number = [&](int column, int j) { return column == 0 ? j * row : count + (column - 1) * row + j; };
    for (int column = 0, t = 0; column < 4; ++column) {
      for (int j = 0; j < kCells; ++j) {
        const int a = number(column, j), b = number(column, j + 1), c = number(column + 1, j);
        beside.F.row(t++) << a, b, c;
        beside.F.row(t++) << b, number(column + 1, j + 1), c;
      }
    }
  }

  BorderCurvature continued(const StartLines& start) const {
    std::vector<Border> border(mesh.V.rows(), Border::kFixed);
    for (int j = 0; j <= kCells; ++j) border[j * (kCells + 1)] = Border::kCurvature;
    const std::vector<ReflectionFunction> families{{frame, frame.z(), {0, 1, 0.3}}};
    return continue_curvature(mesh.V, field, border, beside, frame, kNoCreases, {start}, families);
  }

  // Returns the lines at the start with this gradient in a band beyond x = kFold.
  StartLines lines(double band, double strong) const {
    StartLines start{PlaneVectors::Zero(mesh.F.rows(), 2), strong};
    for (int t = 0; t < mesh.F.rows(); ++t) {
      if (is_in_band(t)) start.gradient(t, 0) = band;
    }
    return start;
  }

  bool is_in_band(int t) const { return x(t) > kFold && x(t) < kFold + 0.1; }

  double x(int t) const { return (mesh.V(mesh.F(t, 0), 0) + mesh.V(mesh.F(t, 1), 0) + mesh.V(mesh.F(t, 2), 0)) / 3; }

  ImagePlane frame{Vector3::UnitZ(), Vector3::UnitY()};
  samples::Mesh mesh;
  HeightField field;
  Surroundings beside;
};

// Counts the triangles that are pulled, on either side of x = kFold.
std::pair<int, int> count_pulled(const Panel& panel, const BorderCurvature& curvature) {
  std::pair<int, int> count{0, 0};
  for (int t = 0; t < panel.mesh.F.rows(); ++t) {
    if (curvature.targets.at(0).weight(t) > 0) ++(panel.x(t) < kFold ? count.first : count.second);
  }
  return count;
}

TEST(BorderCurvature, ThePullEndsAtACreaseThatIsNotHeld) {
  const Panel plain(dome), creased(folded);
  const auto [near, beyond] = count_pulled(plain, plain.continued(plain.lines(0, kCalm)));
  const auto [before, behind] = count_pulled(creased, creased.continued(creased.lines(0, kCalm)));
  EXPECT_GT(beyond, near / 2);
  EXPECT_GT(before, 0.8 * near);
  EXPECT_EQ(behind, 0);
}

TEST(BorderCurvature, ACreaseOfTheSurroundingsLeavesTheirCurvatureUnknown) {
  const Panel panel([](double x, double y) { return dome(x, y) + 0.6 * std::min(x + 0.1, 0.0); });
  EXPECT_EQ(panel.continued(panel.lines(0, kCalm)).unknown, kCells + 1);
}

TEST(BorderCurvature, ThePullEndsWhereLinesBendStronglyAndIsWeakerWhereTheyBend) {
  for (const double jitter : {0.0, 0.2}) {
    const Panel panel(dome, jitter);
    const Vector plain = panel.continued(panel.lines(0, kCalm)).targets.at(0).weight;
    const BorderCurvature stopped = panel.continued(panel.lines(4 * kCalm, kCalm));
    EXPECT_EQ(count_pulled(panel, stopped).second, 0);
    const Vector halved = panel.continued(panel.lines(5.0 / 6 * kCalm, kCalm)).targets.at(0).weight;
    for (int t = 0; t < plain.size(); ++t)
      EXPECT_NEAR(halved(t), (panel.is_in_band(t) ? 0.5 : 1.0) * plain(t), 1e-12 * plain.maxCoeff());
  }
}

// The lines that the surroundings ask for bend strongly, those at the start not at all.
TEST(BorderCurvature, NothingIsPulledToStrongBends) {
  const Panel panel(dome);
  const BorderCurvature curvature = panel.continued(panel.lines(0, 1e-3));
  EXPECT_TRUE(curvature.targets.empty());
  EXPECT_EQ(curvature.strong + curvature.unknown, kCells + 1);
}

}  // namespace
}  // namespace reflines
