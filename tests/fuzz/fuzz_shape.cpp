// Any triangles, borders and targets: solved, or refused in a sentence. What is held does not move, what converged is
// finite, the energy does not rise, and what failed has changed nothing.
#include <vector>

#include "reflection/line_smoother.h"
#include "reflines/shape_optimizer.h"
#include "reflines/uniform_target.h"
#include "tests/fuzz/bytes.h"

namespace reflines {
namespace {

using fuzz::Bytes;

// A grid with holes, doubled and turned faces, and moved vertices: most of it is a surface.
void read_mesh(Bytes& bytes, Positions& V, Triangles& F) {
  const int columns = bytes.between(1, 9), rows = bytes.between(1, 9);
  V.resize((columns + 1) * (rows + 1), 3);
  for (int v = 0; v < V.rows(); ++v) {
    const double x = double(v % (columns + 1)) / columns, y = double(v / (columns + 1)) / rows;
    V.row(v) << x, y, -0.2 * x * x - 0.1 * y * y;
  }
  std::vector<int> corners;
  for (int cell = 0; cell < columns * rows; ++cell) {
    const int a = cell / columns * (columns + 1) + cell % columns, b = a + 1, c = a + columns + 2, d = a + columns + 1;
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  for (int change = bytes.below(12); change > 0 && !bytes.empty(); --change) {
    const int kind = bytes.below(4), place = bytes.below(255) * static_cast<int>(corners.size()) / 255;
    if (kind == 0) V(bytes.below(255) * V.rows() / 255, bytes.below(3)) += 0.2 * bytes.number();
    if (kind == 1) corners[place] = bytes.between(-1, static_cast<int>(std::min<Eigen::Index>(V.rows(), 250)));
    if (kind == 2) std::swap(corners[place], corners[place / 3 * 3]);
    if (kind == 3) corners.erase(corners.begin() + place / 3 * 3, corners.begin() + place / 3 * 3 + 3);
    if (corners.empty()) break;
  }
  F = Eigen::Map<const Triangles>(corners.data(), static_cast<int>(corners.size()) / 3, 3);
}

ShapeOptions read_options(Bytes& bytes, Eigen::Index vertices, Eigen::Index triangles) {
  static constexpr Border kBorders[] = {Border::kFree, Border::kFixed, Border::kClamped};
  ShapeOptions options;
  options.border.assign(bytes.below(30) == 29 ? 3 : vertices, kBorders[bytes.below(3)]);
  if (bytes.flag()) {
    options.held = Mask::Constant(vertices, false);
    for (int k = bytes.below(8); k > 0; --k) options.held(bytes.below(255) * vertices / 255) = true;
  }
  if (bytes.below(8) == 7) options.quadrature_weight = Vector::Constant(bytes.flag() ? triangles : 3, bytes.number());
  if (bytes.flag()) options.linear_solver = LinearSolverKind::kUmfpack;
  return options;
}

Target read_target(Bytes& bytes, ShapeOptimizer& optimizer) {
  switch (bytes.below(4)) {
    case 0:
      return build_smooth_target(optimizer.field(0), optimizer.smoother(0), {std::abs(bytes.number()), bytes.flag()},
                                 0.5 + 0.5 * bytes.number(), 0);
    case 1: {
      UniformOptions options;
      options.density = 2 + 2 * bytes.number();
      options.direction << bytes.number(), bytes.number();
      return build_uniform_target(optimizer.region_field(0), options, {});
    }
    case 2:
      return build_turned_target(optimizer.region_field(0), bytes.number(), {});
    default: {
      Target target;
      target.gradient = PlaneVectors::Constant(optimizer.triangle_count(), 2, bytes.number());
      if (bytes.flag()) target.weight = Vector::Constant(optimizer.triangle_count(), bytes.number());
      return target;
    }
  }
}

void solve(Bytes& bytes, ShapeOptimizer& optimizer, const Positions& V) {
  const Target target = read_target(bytes, optimizer);
  MinimizerOptions options;
  options.max_iterations = bytes.below(6);
  options.strategy = static_cast<Strategy>(bytes.below(4));
  const Positions before = optimizer.positions();
  try {
    const Report report = optimizer.solve({target}, options);
    const Positions after = optimizer.positions();
    const Mask free = optimizer.free();
    fuzz::require(!report.converged() || after.allFinite());
    fuzz::require(report.energy_after <= report.energy_before * (1 + 1e-12));
    for (int v = 0; v < V.rows(); ++v) fuzz::require(free(v) || (after.row(v).array() == V.row(v).array()).all());
  } catch (const std::exception&) {
    fuzz::require((optimizer.positions().array() == before.array()).all());
    throw;
  }
}

}  // namespace
}  // namespace reflines

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace reflines;
  fuzz::Bytes bytes(data, size);
  Positions V;
  Triangles F;
  read_mesh(bytes, V, F);
  fuzz::may_refuse([&] {
    const ShapeOptions options = read_options(bytes, V.rows(), F.rows());
    const Vector3 view(0.3 * bytes.number(), 0.3 * bytes.number(), 1);
    ShapeOptimizer optimizer(V, F, view, {Vector3(1, bytes.number(), bytes.number())}, options);
    for (int k = 0; k < 2; ++k) solve(bytes, optimizer, V);
  });
  return 0;
}
