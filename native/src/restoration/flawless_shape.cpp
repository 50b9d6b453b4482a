#include "restoration/flawless_shape.h"

#include <cmath>
#include <vector>

#include "geometry/bounding_box.h"
#include "geometry/height_field.h"
#include "restoration/bump_removal.h"
#include "restoration/mirror_evidence.h"

namespace reflines {
namespace {

// Height, relative to the diagonal: where vertices that stay differ by more from their partners, the move is not made
// symmetric, which would kink the lines beside them.
constexpr double kSymmetricHold = 1e-5;

// Projects the axes of the object's space to the image plane: mirror planes are looked for across them.
PlanePositions project_axes(const ImagePlane& frame) {
  PlanePositions axes(3, 2);
  for (int k = 0; k < 3; ++k) axes.row(k) = frame.to_frame(Vector3::Unit(k)).head<2>();
  return axes;
}

// Returns true where the control vertices that stay are as high as their partners.
bool is_held_symmetrically(ControlledSurface& surface, const IndexVector& partner) {
  const Positions& C = surface.control_positions();
  const Vector z = surface.optimizer().frame().heights(C);
  const Mask free = surface.control_free();
  const double most = kSymmetricHold * bounding_box_diagonal(C);
  for (Eigen::Index v = 0; v < partner.size(); ++v) {
    const bool moves = free(v) && free(partner(v));
    if (!moves && std::abs(z(v) - z(partner(v))) > most) return false;
  }
  return partner.size() > 0;
}

// Takes the halves' differences out of the shape, which is the start.
void use_symmetry(ControlledSurface& surface, double length, bool has_partners, FlawlessShape& shape) {
  const ShapeOptimizer& optimizer = surface.optimizer();
  const ImagePlane& frame = optimizer.frame();
  const PlanePositions axes = project_axes(frame);
  const MirrorEvidence evidence = find_mirror_evidence(optimizer.xy(), shape.heights, surface.triangles(),
                                                       bounding_box_diagonal(surface.positions()), length, axes);
  shape.mirrored = static_cast<int>(evidence.partner.size());
  if (shape.mirrored == 0) return;
  const Positions& C = surface.control_positions();
  shape.partner = find_mirror_partners(frame.project(C), frame.heights(C), bounding_box_diagonal(C), axes);
  const Mask design = surface.controls_of(evidence.design);
  for (Eigen::Index c = 0; c < shape.partner.size(); ++c) {
    if (design(c)) shape.partner(c) = static_cast<int>(c);
  }
  // Given mirror images move alike whatever was found.
  if (has_partners || !is_held_symmetrically(surface, shape.partner)) shape.partner.resize(0);
  shape.heights += evidence.correction;
}

// Takes bumps out of the shape, which is the start without the halves' differences.
void remove_bumps(ControlledSurface& surface, const Vector& start, double length, Progress* progress,
                  FlawlessShape& shape) {
  const ShapeOptimizer& optimizer = surface.optimizer();
  const Boundary boundary{
      std::vector<Border>(start.size(), Border::kFree), !optimizer.free(), {.rule = CreaseRule::kNone}};
  const HeightField field = make_height_field(surface.positions(), surface.triangles(), optimizer.frame(), boundary);
  Vector move = shape.heights - start;
  Vector sure = move;
  shape.bumps = BumpRemoval(field, length).remove_all(move, sure, progress);
  shape.heights = start + move;
  shape.sure_heights = start + sure;
}

}  // namespace

FlawlessShape find_flawless_shape(ControlledSurface& surface, const Vector& start, double length, FlawSearch search,
                                  bool has_partners, Progress* progress) {
  FlawlessShape result{.heights = start};
  if (search.halves) use_symmetry(surface, length, has_partners, result);
  result.sure_heights = result.heights;
  if (search.bumps) remove_bumps(surface, start, length, progress, result);
  return result;
}

Vector average_partners(ControlledSurface& surface, const IndexVector& partner, const Vector& move) {
  if (partner.size() == 0) return move;
  const Vector z = surface.optimizer().frame().heights(surface.control_positions()) + move;
  const Mask free = surface.control_free();
  Vector result = move;
  for (Eigen::Index v = 0; v < z.size(); ++v) {
    if (free(v) && free(partner(v))) result(v) += 0.5 * (z(partner(v)) - z(v));
  }
  return result;
}

}  // namespace reflines
