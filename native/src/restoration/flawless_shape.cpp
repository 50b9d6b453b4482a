#include "restoration/flawless_shape.h"

#include <cmath>
#include <utility>

#include "geometry/bounding_box.h"
#include "restoration/press_rules.h"

namespace reflines {
namespace {

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
  const double most = kRules.symmetry.held_difference * bounding_box_diagonal(C);
  for (Eigen::Index v = 0; v < partner.size(); ++v) {
    const bool moves = free(v) && free(partner(v));
    if (!moves && std::abs(z(v) - z(partner(v))) > most) return false;
  }
  return partner.size() > 0;
}

}  // namespace

FlawlessShape even_halves(ControlledSurface& surface, const Vector& start, double length, bool has_partners) {
  const ShapeOptimizer& optimizer = surface.optimizer();
  const ImagePlane& frame = optimizer.frame();
  const PlanePositions axes = project_axes(frame);
  MirrorEvidence evidence = find_mirror_evidence(optimizer.xy(), start, surface.triangles(),
                                                 bounding_box_diagonal(surface.positions()), length, axes);
  FlawlessShape result{.heights = start + evidence.correction, .mirrored = evidence.vertices};
  if (evidence.vertices == 0 || has_partners) return result;  // given mirror images move alike whatever was found
  const Positions& C = surface.control_positions();
  const Mask design = surface.controls_of(evidence.design);
  if (!surface.controls_every_vertex())
    evidence.partners = find_mirror_partners(frame.project(C), frame.heights(C), bounding_box_diagonal(C), axes);
  for (MirrorPartners& found : evidence.partners) {
    for (Eigen::Index c = 0; c < found.partner.size(); ++c) {
      if (design(c)) found.partner(c) = static_cast<int>(c);
    }
    if (is_held_symmetrically(surface, found.partner)) result.partners.push_back(std::move(found));
  }
  return result;
}

Vector average_partners(ControlledSurface& surface, const std::vector<MirrorPartners>& partners, const Vector& move) {
  if (partners.empty()) return move;
  const Mask free = surface.control_free();
  const Vector start = surface.optimizer().frame().heights(surface.control_positions());
  Vector result = move;
  for (const MirrorPartners& images : partners) {
    const Vector z = start + result;
    for (Eigen::Index v = 0; v < z.size(); ++v) {
      const int other = images.partner(v);
      if (free(v) && free(other)) result(v) += 0.5 * images.weight * (z(other) - z(v));
    }
  }
  return result;
}

}  // namespace reflines
