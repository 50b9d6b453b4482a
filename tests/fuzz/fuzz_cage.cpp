// Any polygons, creases and corners: subdivided, or refused in a sentence. Positions are weights that sum to 1.
#include <vector>

#include "reflection/line_smoother.h"
#include "reflines/cage_optimizer.h"
#include "reflines/subdivision.h"
#include "tests/fuzz/bytes.h"

namespace reflines {
namespace {

using fuzz::Bytes;

Cage read_cage(Bytes& bytes) {
  Cage cage;
  cage.vertices = bytes.between(0, 24);
  const int faces = bytes.between(0, 40);
  std::vector<int> offsets{0}, corners;
  for (int f = 0; f < faces; ++f) {
    const int size = bytes.between(2, 7);
    for (int i = 0; i < size; ++i) corners.push_back(bytes.between(-1, cage.vertices));
    offsets.push_back(bytes.below(50) == 49 ? bytes.between(-3, 100) : static_cast<int>(corners.size()));
  }
  cage.face_offsets = Eigen::Map<IndexVector>(offsets.data(), static_cast<int>(offsets.size()));
  cage.face_vertices = Eigen::Map<IndexVector>(corners.data(), static_cast<int>(corners.size()));
  const int creases = bytes.below(6), sharp = bytes.below(4);
  cage.creases.resize(creases, 2);
  cage.crease_sharpness.resize(creases);
  for (int c = 0; c < creases; ++c) {
    const int corner = corners.size() < 2 ? 0 : bytes.below(static_cast<int>(corners.size()) - 1);
    cage.creases.row(c) << (corners.empty() ? 0 : corners[corner]), (corners.size() < 2 ? 1 : corners[corner + 1]);
    cage.crease_sharpness[c] = 5 + 5 * bytes.number();
  }
  cage.corners.resize(sharp);
  cage.corner_sharpness.resize(sharp);
  for (int k = 0; k < sharp; ++k) {
    cage.corners[k] = bytes.between(0, cage.vertices);
    cage.corner_sharpness[k] = 5 + 5 * bytes.number();
  }
  return cage;
}

void check(const Cage& cage, const SubdivisionOptions& options) {
  const Subdivision result = subdivide(cage, options);
  const Vector ones = Vector::Ones(cage.vertices);
  fuzz::require(((result.positions * ones).array() - 1).abs().maxCoeff() < 1e-9);
  fuzz::require((result.tangent_u * ones).cwiseAbs().maxCoeff() < 1e-6);
  fuzz::require(result.faces.minCoeff() >= 0 && result.faces.maxCoeff() < result.positions.rows());
  fuzz::require(result.face_parent.minCoeff() >= 0 && result.face_parent.maxCoeff() < cage.face_offsets.size() - 1);
}

}  // namespace
}  // namespace reflines

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace reflines;
  fuzz::Bytes bytes(data, size);
  SubdivisionOptions options;
  options.level = bytes.between(0, 3);
  options.limit = bytes.flag();
  options.scheme = bytes.below(4) == 3 ? SubdivisionScheme::kLoop : SubdivisionScheme::kCatmullClark;
  options.boundary = bytes.flag() ? SubdivisionBoundary::kAll : SubdivisionBoundary::kPreserveCorners;
  const Cage cage = read_cage(bytes);
  fuzz::may_refuse([&] { check(cage, options); });
  Positions V(cage.vertices, 3);
  for (int k = 0; k < V.size(); ++k) V.data()[k] = bytes.number();
  CageOptions whole;
  whole.subdivision = options;
  fuzz::may_refuse([&] {
    CageOptimizer moved(cage, V, {0, 0, 1}, {Vector3(1, 0.2, 0.4)}, whole);
    ShapeOptimizer& optimizer = moved.surface();
    MinimizerOptions few;
    few.max_iterations = 3;
    const Target target = build_smooth_target(optimizer.field(0), optimizer.smoother(0), {0.5, false}, 1, 0);
    const Report report = optimizer.solve({target}, few);
    fuzz::require(moved.cage_positions().allFinite() && report.energy_after <= report.energy_before);
  });
  return 0;
}
