#include "restoration/bump_removal.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/derivatives.h"
#include "geometry/stencil.h"
#include "restoration/bump_search.h"
#include "restoration/crease_preserving_smoother.h"

namespace reflines {
namespace {

// Bounds relative to the length. A bump narrower than the smallest is no wider than the mesh's own facets; one wider
// than the largest is as long as the curves of a design. One flatter than the least is not seen, one deeper than the
// greatest is a feature.
constexpr double kSmallestRadius = 0.25, kLargestRadius = 0.63;
constexpr double kLeastHeight = 7e-4, kGreatestHeight = 0.028;

// Length, relative to that of the flaws, up to which the Hessians are smoothed before bumps are looked for: of 0.6 and
// 0.9 the first finds more dents, and less of the mesh is taken for bumps than without. Creases of ten median jumps are
// kept, so that fillets are not smeared over the dents beside them.
constexpr double kPresmoothed = 0.6;
constexpr SmootherOptions kPresmoother = {.crease_jump = 10.0, .rounds = 4};

PlanePositions centroids(const HeightField& field) {
  PlanePositions result(field.triangle_count(), 2);
  for (int t = 0; t < field.triangle_count(); ++t)
    result.row(t) = (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))) / 3.0;
  return result;
}

HessianSamples read_hessians(const HeightField& field, double length, Progress* progress) {
  TriangleDerivatives u;
  apply_stencils(make_stencils(field, StencilKind::kConsistent), field.z, u);
  TriangleFields hessian = u.rightCols<3>();
  hessian.col(1) *= std::numbers::sqrt2;
  const CreasePreservingSmoother smoother(field.xy, field.F, field.area, length, kPresmoother);
  return {centroids(field), field.area, smoother.smooth(hessian, progress)};
}

PlanePositions free_vertices(const HeightField& field) {
  PlanePositions result(field.vertex_count(), 2);
  Eigen::Index count = 0;
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kFree) result.row(count++) = field.xy.row(v);
  }
  return result.topRows(count);
}

}  // namespace

BumpRemoval remove_bumps(const HeightField& field, double length, Progress* progress) {
  const BumpSearchOptions options{kSmallestRadius * length, kLargestRadius * length, kLeastHeight * length,
                                  kGreatestHeight * length};
  const std::vector<Bump> bumps =
      find_bumps(read_hessians(field, kPresmoothed * length, progress), free_vertices(field), options, progress);
  BumpRemoval result{Vector::Zero(field.vertex_count()), static_cast<int>(bumps.size())};
  for (int v = 0; v < field.vertex_count(); ++v) {
    for (const Bump& bump : bumps) {
      const double distance = (field.xy.row(v).transpose() - bump.center).squaredNorm();
      result.move(v) -= bump.height * std::exp(-distance / (bump.radius * bump.radius));
    }
  }
  return result;
}

}  // namespace reflines
