#include "restoration/press_setup.h"

#include <Eigen/Geometry>

#include "solver/mirror_coupling.h"

namespace reflines {

std::vector<Vector3> make_families(const Vector3& view, const Vector3& lines, const SmoothPanelOptions& options) {
  if (options.set.exist()) return options.set.line_directions;
  if (options.lights == Lights::kSingle) return {lines};
  return {lines, view.cross(lines)};
}

void set_restoration_rules(const SmoothPanelOptions& options, const Vector3& lines, const PressAmount& amount,
                           double proximity, ShapeOptions& shape) {
  if (options.set.exist()) {
    shape.eyes = options.set.eyes;
    shape.eyes.frame_line = lines;
  }
  shape.creases.rule = CreaseRule::kNone;
  shape.proximity = proximity;
  shape.progress = amount.progress;
}

namespace {

std::vector<Border> gather(const std::vector<Border>& border, const std::vector<int>& index) {
  std::vector<Border> result;
  for (const int v : index) result.push_back(border[v]);
  return result;
}

}  // namespace

ShapeOptions choose_shape(const UsedVertices& used, const SmoothPanelOptions& options, Eigen::Index vertex_count) {
  ShapeOptions shape;
  if (!options.border.empty()) shape.border = gather(options.border, used.index);
  if (options.held.size() > 0) shape.held = options.held(used.index);
  if (options.partner.size() > 0) {
    shape.partner = renumber_partners(options.partner, used);
    const Mask alone = shape.partner.array() < 0 && options.partner(used.index).array() >= 0;
    shape.held = shape.held.size() > 0 ? Mask(shape.held || alone) : alone;
  }
  if (options.around.exist())
    shape.around = renumber_surroundings(options.around, used, static_cast<int>(vertex_count));
  shape.face_of_triangle = options.face_of_triangle;
  return shape;
}

}  // namespace reflines
