// Any triangles, borders, mirror images, targets and limits: solved, or refused in a sentence. What is held does not
// move, nothing moves further than its limit, mirror images move alike, what converged is finite, the energy does not
// rise, and what failed has changed nothing.
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "reflection/line_smoother.h"
#include "reflines/shape_optimizer.h"
#include "reflines/uniform_target.h"
#include "tests/fuzz/bytes.h"
#include "tests/fuzz/meshes.h"

namespace reflines {
namespace {

using fuzz::Bytes;

ShapeOptions read_options(Bytes& bytes, Eigen::Index vertices, Eigen::Index triangles) {
  static constexpr Border kBorders[] = {Border::kFree, Border::kFixed, Border::kClamped};
  ShapeOptions options;
  options.border.assign(bytes.below(30) == 29 ? 3 : vertices, kBorders[bytes.below(3)]);
  options.held = fuzz::read_held(bytes, vertices);
  if (bytes.below(8) == 7) options.quadrature_weight = Vector::Constant(bytes.flag() ? triangles : 3, bytes.number());
  if (bytes.flag()) options.linear_solver = LinearSolverKind::kUmfpack;
  return options;
}

// Pairs of vertices anywhere, or the images of the grid before its vertices moved; sometimes what is no pairing.
IndexVector read_partner(Bytes& bytes, Eigen::Index vertices) {
  IndexVector partner = IndexVector::LinSpaced(vertices, 0, static_cast<int>(vertices) - 1);
  const int row = bytes.between(2, 10);
  if (bytes.flag()) {
    for (int v = 0; v < vertices; ++v) {
      const int image = v / row * row + row - 1 - v % row;
      if (image < vertices) partner(v) = image;
    }
  }
  for (int pair = bytes.below(6); pair > 0; --pair) {
    const int a = bytes.below(255) * static_cast<int>(vertices) / 255;
    const int b = bytes.below(255) * static_cast<int>(vertices) / 255;
    if (partner(a) != a || partner(b) != b) continue;
    std::swap(partner(a), partner(b));
  }
  if (bytes.below(16) == 15) partner(bytes.below(255) * vertices / 255) = bytes.between(-1, 254);
  return partner;
}

// The symmetry of a region and the faces of its triangles, from the last bytes: the others keep their meaning.
void read_counterparts(Bytes bytes, Eigen::Index triangles, ShapeOptions& options) {
  const int kinds = bytes.below(8);
  if (kinds == 6 || kinds == 7) options.partner = read_partner(bytes, options.border.size());
  if (kinds != 5 && kinds != 7) return;
  options.face_of_triangle.resize(bytes.below(20) == 19 ? 3 : triangles);
  const int most = bytes.between(1, 250);
  for (int& face : options.face_of_triangle) face = most == 250 ? std::numeric_limits<int>::min() : bytes.below(most);
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
      return build_turned_target(optimizer.region_field(0), {.angle = bytes.number()}, {});
    default: {
      Target target;
      target.gradient = PlaneVectors::Constant(optimizer.triangle_count(), 2, bytes.number());
      if (bytes.flag()) target.weight = Vector::Constant(optimizer.triangle_count(), bytes.number());
      return target;
    }
  }
}

// One length, or each vertex's own range; sometimes neither is a limit.
MoveLimit read_limit(Bytes& bytes, int vertices) {
  const int kind = bytes.below(4);
  if (kind == 1) return MoveLimit::within(0.02 * std::abs(bytes.number()), vertices);
  if (kind != 2) return MoveLimit::none();
  MoveLimit limit{Vector(vertices), Vector(vertices)};
  for (int v = 0; v < vertices; ++v) {
    limit.lowest(v) = -0.01 * std::abs(bytes.number());
    limit.highest(v) = bytes.below(50) == 49 ? bytes.number() : 0.01 * std::abs(bytes.number());
  }
  return limit;
}

// The moves are the same bits; heights, which are theirs added to different starts, are rounded.
void require_alike(const IndexVector& partner, const Vector& heights, const Vector& start, const Mask& free) {
  for (int v = 0; v < partner.size(); ++v) {
    const int image = partner(v);
    if (!free(v) || image < 0) continue;
    const double size = std::abs(heights(v)) + std::abs(start(v)) + std::abs(heights(image)) + std::abs(start(image));
    fuzz::require(std::abs(heights(v) - start(v) - heights(image) + start(image)) <= 1e-15 * size);
  }
}

// Of the free vertices, since the others keep their bits, and those in no face may have any.
void require_within(const MoveLimit& limit, const Vector& move, const Mask& free) {
  if (!limit.exists()) return;
  for (int v = 0; v < move.size(); ++v)
    fuzz::require(!free(v) || (move(v) <= limit.highest(v) && move(v) >= limit.lowest(v)));
}

void solve(Bytes& bytes, ShapeOptimizer& optimizer, const Positions& V, const IndexVector& partner) {
  const Target target = read_target(bytes, optimizer);
  MinimizerOptions options;
  options.max_iterations = bytes.below(6);
  options.strategy = static_cast<Strategy>(bytes.below(4));
  const MoveLimit limit = read_limit(bytes, static_cast<int>(V.rows()));
  const Positions before = optimizer.positions();
  try {
    const Report report = optimizer.solve({target}, options, nullptr, limit);
    const Positions after = optimizer.positions();
    const Mask free = optimizer.free();
    fuzz::require(std::isfinite(report.largest_move));
    fuzz::require(report.energy_after <= report.energy_before * (1 + 1e-12));
    require_alike(partner, optimizer.heights(), optimizer.frame().heights(V), free);
    require_within(limit, optimizer.heights() - optimizer.frame().heights(V), free);
    for (int v = 0; v < V.rows(); ++v) fuzz::require(free(v) || fuzz::are_same(after.row(v), V.row(v)));
  } catch (const std::exception&) {
    fuzz::require(fuzz::are_same(optimizer.positions(), before));
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
  fuzz::read_mesh(bytes, V, F);
  fuzz::may_refuse([&] {
    ShapeOptions options = read_options(bytes, V.rows(), F.rows());
    const std::size_t last = std::min<std::size_t>(size, 64);
    read_counterparts(Bytes(data + size - last, last), F.rows(), options);
    const Vector3 view(0.3 * bytes.number(), 0.3 * bytes.number(), 1);
    ShapeOptimizer optimizer(V, F, view, {Vector3(1, bytes.number(), bytes.number())}, options);
    for (int k = 0; k < 2; ++k) solve(bytes, optimizer, V, options.partner);
  });
  return 0;
}
