// Any panels and cages under a press of Smooth: made smoother, or refused in a sentence. What is held does not move,
// nothing moves further than the limit, and what is not applied has changed nothing.
#include <algorithm>
#include <cmath>
#include <vector>

#include "reflines/smooth_panel.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/meshes.h"

namespace reflines {
namespace {

using fuzz::Bytes;

SmoothPanelOptions read_options(Bytes& bytes) {
  SmoothPanelOptions options;
  options.lights = bytes.flag() ? Lights::kSingle : Lights::kCrossed;
  options.symmetric = !bytes.flag();
  if (bytes.flag()) options.length = std::abs(bytes.number());
  if (bytes.flag()) options.limit = 0.02 * std::abs(bytes.number());
  options.strength = bytes.below(4) == 3 ? bytes.number() : 1.0;
  return options;
}

void check(const SmoothPanelResult& result, const Positions& before, const Vector3& view, const Mask& held) {
  const SmoothPanelReport& report = result.report;
  fuzz::require(std::isfinite(report.length) && report.line_deviation.allFinite());
  for (int v = 0; v < before.rows(); ++v) {
    const bool stays = !report.applied || (held.size() > 0 && held(v));
    if (fuzz::are_same(result.positions.row(v), before.row(v))) continue;
    const double rounding = 1e-12 * std::max(1.0, before.row(v).cwiseAbs().maxCoeff());
    const double move = (result.positions.row(v) - before.row(v)).dot(view.normalized());
    fuzz::require(!stays && std::abs(move) <= report.limit + rounding);
  }
  for (size_t k = 0; report.applied && k < report.unevenness_after.size(); ++k)
    fuzz::require(report.unevenness_after[k] <= 1.01 * report.unevenness_before[k]);
}

void press_mesh(Bytes& bytes, const Vector3& view, const Vector3& line) {
  static constexpr Border kBorders[] = {Border::kClamped, Border::kFixed, Border::kFree};
  Positions V;
  Triangles F;
  fuzz::read_mesh(bytes, V, F);
  SmoothPanelOptions options = read_options(bytes);
  options.border.assign(V.rows(), kBorders[bytes.below(3)]);
  options.held = fuzz::read_held(bytes, V.rows());
  check(smooth_panel(V, F, view, line, options), V, view, options.held);
}

// A sheet of quads, with moved vertices, triangles among them, and creases.
void press_cage(Bytes& bytes, const Vector3& view, const Vector3& line) {
  const int columns = bytes.between(2, 4), rows = bytes.between(2, 4), vertices = (columns + 1) * (rows + 1);
  Positions V(vertices, 3);
  for (int v = 0; v < vertices; ++v) {
    const double x = double(v % (columns + 1)) / columns, y = double(v / (columns + 1)) / rows;
    V.row(v) << x, y, -0.2 * x * x - 0.1 * y * y;
  }
  for (int k = bytes.below(12); k > 0; --k) V(bytes.below(vertices), bytes.below(3)) += 0.1 * bytes.number();
  Eigen::MatrixXi quads(columns * rows, 4);
  for (int f = 0; f < quads.rows(); ++f) {
    const int a = f / columns * (columns + 1) + f % columns;
    quads.row(f) << a, a + 1, a + columns + 2, a + columns + 1;
  }
  Cage cage = cage_from_faces(vertices, quads);
  cage.creases.resize(bytes.below(5), 2);
  cage.crease_sharpness.resize(cage.creases.rows());
  for (int c = 0; c < cage.creases.rows(); ++c) {
    cage.creases.row(c) = quads.row(bytes.below(static_cast<int>(quads.rows()))).head<2>();
    cage.crease_sharpness(c) = 5 + 5 * bytes.number();
  }
  CageOptions options;
  options.subdivision.level = bytes.between(1, 2);
  options.subdivision.limit = !bytes.flag();
  options.border.assign(vertices, bytes.flag() ? Border::kFixed : Border::kClamped);
  options.held = fuzz::read_held(bytes, vertices);
  check(smooth_cage_panel(cage, V, view, line, options, read_options(bytes)), V, view, options.held);
}

}  // namespace
}  // namespace reflines

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace reflines;
  fuzz::Bytes bytes(data, size);
  const bool cage = bytes.below(3) == 2;
  const Vector3 view(0.3 * bytes.number(), 0.3 * bytes.number(), 1), line(1, bytes.number(), bytes.number());
  fuzz::may_refuse([&] { cage ? press_cage(bytes, view, line) : press_mesh(bytes, view, line); });
  return 0;
}
