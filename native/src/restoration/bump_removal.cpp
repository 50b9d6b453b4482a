#include "restoration/bump_removal.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/derivatives.h"

namespace reflines {
namespace {

// Bounds relative to the length. A bump narrower than the smallest is no wider than the mesh's own facets; one wider
// than the largest is as long as the curves of a design. One flatter than the least is not seen.
constexpr double kSmallestRadius = 0.25, kLargestRadius = 0.63;
constexpr double kLeastHeight = 7e-4;

// Height over radius. A dent of 1.3 per mille of the diagonal, 5 % of it wide, is as steep, and of its lines four
// degrees are off. Of 0.024, 0.05 and 0.08, on analytic panels: of ripples beside a scoop of 0.6 % of the diagonal
// 0.24, 0.24 and 1.1 is left (1.2 with a bound of the height alone), and of dents of 1.8 per mille 0.9, 0.14 and 0.14.
// A scoop of 0.3 % and a row of knobs are as steep as such dents, and nothing tells them from these: clean ones are
// harmed by 0.5 and 0.8 degrees from 0.05 on.
constexpr double kSteepness = 0.05;

// The largest radius relative to the diagonal of the piece that a bump is on, one of several that were selected
// together. A bump of 0.18 diagonals was the bow of a lamp on the bonnet of a car, selected whole: without the pull to
// the start it went by 3 per mille of the car's diagonal. On a piece alone the length gives 0.045.
constexpr double kLargestShare = 0.09;

constexpr int kRounds = 3;

// Length, relative to that of the flaws, up to which the Hessians are smoothed before bumps are looked for: of 0.6 and
// 0.9 the first finds more dents, and less of the mesh is taken for bumps than without. Creases of 15 median jumps are
// kept, so that fillets are not smeared over the dents beside them: of 10, 15 and 20, 0.25, 0.23, 0.23 of dents are
// left on four panels, and on these with 600 vertices 0.11, 0.11, 0.16 degrees of harm.
constexpr double kPresmoothed = 0.6;
constexpr SmootherOptions kPresmoother = {.crease_jump = 15.0, .rounds = 4};

PlanePositions centroids(const HeightField& field) {
  PlanePositions result(field.triangle_count(), 2);
  for (int t = 0; t < field.triangle_count(); ++t)
    result.row(t) = (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))) / 3.0;
  return result;
}

Vector largest_radii(const HeightField& field) {
  const Vector diagonal = field.piece_diagonals();
  Vector result(field.triangle_count());
  for (int t = 0; t < result.size(); ++t) result(t) = kLargestShare * diagonal(field.piece[t]);
  return result;
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

BumpRemoval::BumpRemoval(const HeightField& field, double length)
    : xy_(field.xy),
      seeds_(free_vertices(field)),
      z_(field.z),
      length_(length),
      stencils_(make_stencils(field, StencilKind::kConsistent)),
      smoother_(field.xy, field.F, field.area, kPresmoothed * length, kPresmoother),
      centers_(centroids(field)),
      area_(field.area),
      largest_radius_(largest_radii(field)) {}

TriangleFields BumpRemoval::read_hessians(const Vector& z, Progress* progress) const {
  TriangleDerivatives u;
  apply_stencils(stencils_, z, u);
  TriangleFields hessian = u.rightCols<3>();
  hessian.col(1) *= std::numbers::sqrt2;
  return smoother_.smooth_with(smoother_.find_creases(hessian, progress), hessian);
}

bool BumpRemoval::is_wide(const Bump& bump) const {
  Eigen::Index nearest = 0;
  (centers_.rowwise() - bump.center.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return bump.radius > largest_radius_(nearest);
}

void BumpRemoval::remove(const std::vector<Bump>& bumps, Vector& move, Vector& sure) const {
  for (const Bump& bump : bumps) {
    const double trust = is_wide(bump) ? 0.0 : bump.explained;
    for (Eigen::Index v = 0; v < move.size(); ++v) {
      const double distance = (xy_.row(v).transpose() - bump.center).squaredNorm();
      const double height = bump.height * std::exp(-distance / (bump.radius * bump.radius));
      move(v) -= height;
      sure(v) -= trust * height;
    }
  }
}

int BumpRemoval::remove_all(Vector& move, Vector& sure, Progress* progress) const {
  const BumpSearchOptions options{kSmallestRadius * length_, kLargestRadius * length_, kLeastHeight * length_,
                                  kSteepness};
  int count = 0;
  std::vector<Bump> removed;
  for (int round = 0; round < kRounds && (round == 0 || !removed.empty()); ++round) {
    const HessianSamples samples{centers_, area_, read_hessians(z_ + move, progress)};
    removed = find_bumps(samples, seeds_, removed, options, progress);
    remove(removed, move, sure);
    count += static_cast<int>(removed.size());
  }
  return count;
}

}  // namespace reflines
