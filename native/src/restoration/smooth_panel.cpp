#include "reflines/smooth_panel.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "geometry/mesh.h"
#include "reflines/errors.h"
#include "restoration/controlled_surface.h"
#include "restoration/faired_border.h"
#include "restoration/held_border.h"
#include "restoration/restoration.h"
#include "restoration/used_vertices.h"
#include "solver/limited_move.h"
#include "solver/mirror_coupling.h"
#include "solver/solve_checks.h"
#include "threads/abandonable_work.h"

namespace reflines {
namespace {

std::vector<Vector3> make_families(const Vector3& view, const Vector3& lines, Lights lights) {
  if (lights == Lights::kSingle) return {lines};
  return {lines, view.cross(lines)};
}

// Sets the options that all presses share. Noise makes creases, and held ones would keep it; smoother and weights keep
// what bends.
void set_restoration_rules(const SmoothPanelOptions& options, double proximity, ShapeOptions& shape) {
  shape.creases.rule = CreaseRule::kNone;
  shape.proximity = proximity;
  shape.progress = options.progress;
}

// Throws unless there are shares of the limit for all vertices, or for none.
void check_share(const MoveLimit& share, Eigen::Index vertex_count) {
  if (!share.exists() && share.lowest.size() == 0) return;
  check(share, static_cast<int>(vertex_count));
  const auto beyond = (share.lowest.array() < -1 || share.highest.array() > 1).count();
  if (beyond == 0) return;
  throw InvalidInput("The share of the limit of " + std::to_string(beyond) + " of the " + std::to_string(vertex_count) +
                     " vertices is beyond it; give -1 to 0 for the lowest move and 0 to 1 for the highest.");
}

void check_mask(const Mask& mask, const std::string& name, Eigen::Index vertex_count) {
  if (mask.size() == 0 || mask.size() == vertex_count) return;
  throw InvalidInput("The " + name + " mask has " + std::to_string(mask.size()) + " entries for " +
                     std::to_string(vertex_count) + " vertices; give one for each.");
}

void check(const SmoothPanelOptions& options, Eigen::Index vertex_count) {
  const auto refuse = [](const char* what) { throw InvalidInput(what); };
  if (!(options.length >= 0) || !std::isfinite(options.length))
    refuse("The length must be a positive length, or 0 for automatic.");
  if (!(options.flaw_size > 0) || !std::isfinite(options.flaw_size)) refuse("The flaw size must be a number above 0.");
  if (!(options.limit >= 0)) refuse("The limit must be a positive length, or 0 for automatic.");
  if (!(options.strength >= 0 && options.strength <= 1)) refuse("The strength must lie between 0 and 1.");
  check_share(options.limit_share, vertex_count);
  if (!options.border.empty() && static_cast<Eigen::Index>(options.border.size()) != vertex_count) {
    throw InvalidInput("There are " + std::to_string(options.border.size()) + " border codes for " +
                       std::to_string(vertex_count) + " vertices; give one for each.");
  }
  check_mask(options.held, "held", vertex_count);
  check_mask(options.fair_border, "fair border", vertex_count);
}

// Runs a press, which owns its arguments, so that nobody waits for one that is cancelled.
SmoothPanelResult run_press(const std::shared_ptr<Progress>& progress,
                            const std::function<SmoothPanelResult()>& press) {
  const auto result = std::make_shared<SmoothPanelResult>();
  run_abandonable(progress.get(), [result, press] { *result = press(); });
  return std::move(*result);
}

std::vector<Border> gather(const std::vector<Border>& border, const std::vector<int>& index) {
  std::vector<Border> result;
  for (const int v : index) result.push_back(border[v]);
  return result;
}

SmoothPanelResult press_mesh(const Positions& V, const Triangles& F, const Vector3& view,
                             const std::vector<Vector3>& families, const ShapeOptions& shape,
                             const SmoothPanelOptions& options) {
  if (options.fair_border.any()) return press_faired_border(V, F, view, families, shape, options);
  return press_held_border(V, F, view, families, shape, options);
}

// Presses the vertices that are in faces; the others keep their bits.
SmoothPanelResult press_used_vertices(const Positions& V, const UsedVertices& used, const Vector3& view_direction,
                                      const Vector3& line_direction, const SmoothPanelOptions& options) {
  ShapeOptions shape;
  if (!options.border.empty()) shape.border = gather(options.border, used.index);
  if (options.held.size() > 0) shape.held = options.held(used.index);
  if (options.partner.size() > 0) {
    shape.partner = renumber_partners(options.partner, used);
    const Mask alone = shape.partner.array() < 0 && options.partner(used.index).array() >= 0;
    shape.held = shape.held.size() > 0 ? Mask(shape.held || alone) : alone;
  }
  if (options.around.exist()) shape.around = renumber_surroundings(options.around, used, static_cast<int>(V.rows()));
  shape.face_of_triangle = options.face_of_triangle;
  set_restoration_rules(options, kMeshProximity, shape);
  SmoothPanelOptions own = options;
  own.partner = shape.partner;
  if (own.limit_share.exists())
    own.limit_share = {options.limit_share.lowest(used.index), options.limit_share.highest(used.index)};
  own.limit_share = intersect_limits(own.limit_share, own.partner);
  if (own.fair_border.size() > 0) own.fair_border = options.fair_border(used.index);
  SmoothPanelResult result = press_mesh(V(used.index, Eigen::all), used.F, view_direction,
                                        make_families(view_direction, line_direction, options.lights), shape, own);
  Positions all = V;
  all(used.index, Eigen::all) = result.positions;
  result.positions = std::move(all);
  return result;
}

}  // namespace

SmoothPanelResult smooth_panel(const Positions& V, const Triangles& F, const Vector3& view_direction,
                               const Vector3& line_direction, const SmoothPanelOptions& options) {
  check(options, V.rows());
  check_surroundings(options.around, V.rows());
  check_partners(options.partner, V.rows());
  check_surface(V, F);
  check_face_of_triangle(options.face_of_triangle, F.rows());
  return run_press(options.progress, [=] {
    const UsedVertices used = find_used_vertices(F, static_cast<int>(V.rows()));
    return press_used_vertices(V, used, view_direction, line_direction, options);
  });
}

SmoothPanelResult smooth_cage_panel(const Cage& cage, const Positions& V, const Vector3& view_direction,
                                    const Vector3& line_direction, const CageOptions& cage_options,
                                    const SmoothPanelOptions& options) {
  check(options, V.rows());
  if (options.fair_border.any())
    throw InvalidInput("The border of a cage cannot be faired: only that of a mesh, by the faces beside it.");
  return run_press(options.progress, [=] {
    CageOptions own = cage_options;
    set_restoration_rules(options, kCageProximity, own.shape);
    CageControlledSurface surface(cage, V, view_direction,
                                  make_families(view_direction, line_direction, options.lights), own);
    SmoothPanelOptions with_partners = options;
    with_partners.limit_share = intersect_limits(options.limit_share, cage_options.partner);
    return Restoration(surface, with_partners).run();
  });
}

}  // namespace reflines
