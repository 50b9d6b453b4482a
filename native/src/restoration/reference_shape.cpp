#include "restoration/reference_shape.h"

#include <cmath>
#include <utility>

#include "geometry/bounding_box.h"
#include "restoration/mean_plane.h"
#include "restoration/mirror_evidence.h"
#include "restoration/press_rules.h"
#include "restoration/triangle_slopes.h"

namespace reflines {
namespace {

// Returns the axes of the object's space in the coordinates of the view: mirror planes are looked for across them.
Positions turn_axes(const ImagePlane& frame) {
  Positions axes(3, 3);
  for (int k = 0; k < 3; ++k) axes.row(k) = frame.to_frame(Vector3::Unit(k));
  return axes;
}

// Returns the vertices of a cage as the view sees them, with the mean slope of its surface.
SeenPoints see_cage(const ControlledSurface& surface, const ImagePlane& frame, const Vector2& slope) {
  const Positions& C = surface.control_positions();
  const double tolerance = kRules.symmetry.pair_tolerance * bounding_box_diagonal(C);
  SeenPoints result{Positions(C.rows(), 3), slope.transpose().replicate(C.rows(), 1),
                    Vector::Constant(C.rows(), tolerance)};
  result.P << frame.project(C), frame.heights(C);
  result.P.rowwise() -= result.P.colwise().mean().eval();
  return result;
}

// Returns the vertices (#V) that differ from some image by design, where the surface is symmetric otherwise.
Mask find_designed(const std::vector<MirrorImages>& across) {
  Mask result = across.front().design && across.front().weight.array() > 0;
  for (const MirrorImages& images : across) result = result || (images.design && images.weight.array() > 0);
  return result;
}

// Leaves those images that are each other's, no deeper than flaws are apart, and not different by design.
void keep_partners(MirrorImages& images) {
  const MirrorImages found = images;
  for (Eigen::Index c = 0; c < found.image.size(); ++c) {
    const int image = found.image(c);
    if (found.image(image) == c && found.paired(c) && found.paired(image) && !found.design(c)) continue;
    images.image(c) = static_cast<int>(c);
    images.paired(c) = false;
    images.kept(c) = 0.0;
  }
}

// Returns true where the control vertices that stay are mirror images.
bool is_held_symmetrically(const Mask& free, const SeenPoints& points, const MirrorImages& images, double diagonal) {
  const Vector rise = find_mirrored_rise(points, images) - images.kept;
  for (Eigen::Index c = 0; c < rise.size(); ++c) {
    const bool moves = free(c) && free(images.image(c));
    if (!moves && std::abs(rise(c)) > kRules.symmetry.held_difference * diagonal) return false;
  }
  return rise.size() > 0;
}

}  // namespace

ReferenceShape even_halves(ControlledSurface& surface, const HeightField& field, const Vector& z, double length,
                           bool has_partners) {
  const ImagePlane& frame = surface.optimizer().frame();
  const Positions axes = turn_axes(frame);
  MirrorEvidence evidence = find_mirror_evidence(field, z, bounding_box_diagonal(surface.positions()), length, axes);
  ReferenceShape result{.correction = std::move(evidence.correction)};
  if (evidence.images.empty()) return result;
  Vector weight = Vector::Zero(field.vertex_count());
  for (const MirrorImages& images : evidence.images) weight = weight.cwiseMax(images.weight);
  result.mirrored = static_cast<int>((weight.array() > 0.5).count());
  if (has_partners) return result;  // given mirror images move alike whatever was found
  const double diagonal = bounding_box_diagonal(surface.control_positions());
  if (surface.controls_every_vertex()) {
    // A dent moves its vertices aside, and their images lie in the surface without it.
    result.control = see_vertices(field, diagonal);
    result.control.slope = find_vertex_gradients(field.xy, field.F, z + result.correction);
  } else {
    const MeanPlane plane(field);
    result.control = see_cage(surface, frame, plane.slope());
    const Mask design = surface.controls_of(find_designed(evidence.images));
    evidence.images = find_mirror_images(result.control, diagonal, length, axes, plane.normal());
    for (MirrorImages& images : evidence.images) {
      images.design = design;
      images.kept = find_kept_difference(result.control, images, plane.normal(), diagonal, length);
    }
  }
  const Mask free = surface.control_free();
  for (MirrorImages& images : evidence.images) {
    keep_partners(images);
    if (is_held_symmetrically(free, result.control, images, diagonal)) result.partners.push_back(std::move(images));
  }
  return result;
}

Vector average_partners(ControlledSurface& surface, const ReferenceShape& reference, const Vector& move) {
  if (reference.partners.empty()) return move;
  const Mask free = surface.control_free();
  Vector result = move;
  for (const MirrorImages& images : reference.partners) {
    SeenPoints moved = reference.control;
    moved.P.col(2) += result;
    const Vector rise = find_mirrored_rise(moved, images) - images.kept;
    for (Eigen::Index c = 0; c < rise.size(); ++c) {
      if (free(c) && free(images.image(c))) result(c) += 0.5 * images.weight(c) * rise(c);
    }
  }
  return result;
}

}  // namespace reflines
