// Any images, lattices and fall-offs over a fixed panel: a finite target, or refused in a sentence.
#include "reflines/pattern_target.h"
#include "reflines/shape_optimizer.h"
#include "reflines/uniform_target.h"
#include "reflines/warp_target.h"
#include "tests/fuzz/bytes.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

using fuzz::Bytes;

ShapeOptimizer& panel() {
  static auto* const optimizer = [] {
    samples::Mesh mesh = samples::grid(6, 0.2);
    mesh.V.col(2) = -0.2 * mesh.V.col(0).array().square() - 0.1 * mesh.V.col(1).array().square();
    return new ShapeOptimizer(mesh.V, mesh.F, {0, 0, 1}, {Vector3(1, 0.2, 0.4)});
  }();
  return *optimizer;
}

void check(const Target& target) {
  fuzz::require(target.gradient.allFinite() && target.theta.allFinite() && target.weight.allFinite());
}

void pattern(Bytes& bytes, const RegionField& field) {
  PatternOptions options;
  options.strength = bytes.number();
  options.blur = 4 * std::abs(bytes.number());
  options.keep = 0.5 + 0.5 * bytes.number();
  options.centre << bytes.number(), bytes.number();
  options.width = bytes.number();
  options.angle = 4 * bytes.number();
  options.by_value = bytes.flag();
  Eigen::MatrixXd image(bytes.below(12), bytes.below(12));
  for (int k = 0; k < image.size(); ++k) image.data()[k] = bytes.number();
  if (image.size() > 0 && !(image.cwiseAbs().maxCoeff() * std::abs(options.strength) < 1e100)) return;
  if (std::abs(options.width) < 1e-100) return;  // a gradient of 1e300 is one, and need not be finite
  check(build_pattern_target(field, image, options));
}

void warp(Bytes& bytes, const RegionField& field) {
  WarpGrid grid;
  grid.low << -0.1 + 0.1 * bytes.number(), -0.1 + 0.1 * bytes.number();
  grid.high << 1.1 + 0.1 * bytes.number(), 1.1 + 0.1 * bytes.number();
  grid.columns = bytes.between(0, 8);
  grid.rows = bytes.between(0, 8);
  const int points = (grid.columns + 1) * (grid.rows + 1) - (bytes.below(20) == 19);
  grid.position.resize(points, 2);
  for (int k = 0; k < points; ++k) {
    const double x = double(k % (grid.columns + 1)) / std::max(grid.columns, 1);
    const double y = double(k / (grid.columns + 1)) / std::max(grid.rows, 1);
    grid.position.row(k) << 1.2 * x - 0.1 + 0.1 * bytes.number(), 1.2 * y - 0.1 + 0.1 * bytes.number();
  }
  check(build_warp_target(field, grid, bytes.flag()).target);
}

void uniform(Bytes& bytes, const RegionField& field) {
  Vector curve(bytes.below(6));
  for (int k = 0; k < curve.size(); ++k) curve(k) = 0.5 + 0.5 * bytes.number();
  Vector influence;
  const Vector2 centre(bytes.number(), bytes.number());
  if (bytes.flag()) influence = falloff(field, centre, bytes.number(), curve);
  UniformOptions options;
  options.direction << bytes.number(), bytes.number();
  options.axis << bytes.number(), bytes.number();
  options.density = bytes.number();
  options.density_end = bytes.number();
  options.relative = bytes.flag();
  if (std::max(options.density, options.density_end) > 1e100 || options.axis.norm() > 1e100) return;
  check(build_uniform_target(field, options, influence));
}

}  // namespace
}  // namespace reflines

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace reflines;
  fuzz::Bytes bytes(data, size);
  const RegionField& field = panel().region_field(0);
  fuzz::may_refuse([&] {
    const int kind = bytes.below(3);
    if (kind == 0) pattern(bytes, field);
    if (kind == 1) warp(bytes, field);
    if (kind == 2) uniform(bytes, field);
  });
  return 0;
}
