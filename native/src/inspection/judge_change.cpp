#include "reflines/judge_change.h"

#include <cmath>
#include <memory>
#include <vector>

#include "geometry/centroids.h"
#include "geometry/height_field.h"
#include "geometry/mesh.h"
#include "inspection/changed_region.h"
#include "inspection/reference_surface.h"
#include "reflines/errors.h"
#include "restoration/disk_mean.h"
#include "restoration/triangle_slopes.h"
#include "restoration/used_vertices.h"
#include "restoration/worse_place.h"
#include "solver/families.h"
#include "threads/abandonable_work.h"

namespace reflines {
namespace {

// Radius of the mean, relative to the length: that of inspect_panel.
constexpr double kRadius = 0.35;

void check(const Positions& before, const Positions& after, const Triangles& F, const LightSet& lights, double length) {
  check_surface(before, F);
  if (after.rows() != before.rows() || !after.allFinite())
    throw InvalidInput("The positions after the change must be finite numbers, one for each vertex before it.");
  if (!(length > 0) || !std::isfinite(length)) throw InvalidInput("The length must be a positive length.");
  if (!lights.exist() || !lights.eyes.exist())
    throw InvalidInput("Lights that judge a change need eye directions; give one for each.");
}

// Returns the values of the field's triangles among those of all.
std::vector<Vector> choose(const std::vector<Vector>& every, const std::vector<int>& source) {
  std::vector<Vector> result;
  for (const Vector& each : every) result.emplace_back(each(source));
  return result;
}

// Lets triangles of the panel that are not judged hide those that are.
void block(const Positions& V, const Triangles& F, Eyes& eyes) {
  const Eigen::Index vertices = eyes.blocker_vertices.rows(), triangles = eyes.blockers.rows();
  eyes.blocker_vertices.conservativeResize(vertices + V.rows(), 3);
  eyes.blocker_vertices.bottomRows(V.rows()) = V;
  eyes.blockers.conservativeResize(triangles + F.rows(), 3);
  eyes.blockers.bottomRows(F.rows()) = F.array() + static_cast<int>(vertices);
}

WorsePlace judge_region(const Positions& before, const Positions& after, const Triangles& F, const ImagePlane& frame,
                        const LightSet& lights, double length, Progress* progress) {
  const UsedVertices used = find_used_vertices(F, static_cast<int>(before.rows()));
  const Positions V = before(used.index, Eigen::all), moved = after(used.index, Eigen::all);
  const Boundary boundary{std::vector<Border>(V.rows(), Border::kFixed), {}, {.rule = CreaseRule::kNone}};
  HeightField field = make_height_field(V, used.F, frame, boundary);
  Families families = make_families(V, used.F, frame, lights.line_directions, lights.eyes);
  families.sight = choose(families.sight, field.source);
  ChangedSlopes slopes;
  slopes.before = find_slopes(field.xy, field.F, field.z);
  slopes.course_before = find_reference_surface(field, length, progress).slopes;
  field.z += (moved - V) * frame.z();
  slopes.after = find_slopes(field.xy, field.F, field.z);
  slopes.course_after = find_reference_surface(field, length, progress).slopes;
  const DiskMean around(find_centroids(field.xy, field.F), field.area, kRadius * length);
  return find_worse_place(families, slopes, around, V, field.F, kJudgedWorse);
}

// Judges where the change can be seen: what a line pulled near one corner did is known in a tenth of the time.
WorsePlace judge(const Positions& before, const Positions& after, const Triangles& F, const Vector3& view_direction,
                 const LightSet& lights, double length, Progress* progress) {
  const ImagePlane frame = choose_frame(view_direction, lights.line_directions, lights.eyes);
  const UsedVertices used = find_used_vertices(F, static_cast<int>(before.rows()));
  const Positions V = before(used.index, Eigen::all), moved = after(used.index, Eigen::all);
  const Mask changed = find_changed_region(V, moved, used.F, frame, length);
  if (!changed.any()) {
    make_families(V, Triangles(0, 3), frame, lights.line_directions, lights.eyes);  // throws for lights that are none
    return {};
  }
  LightSet own = lights;
  if (!changed.all()) block(V, used.F(list_marked(!changed), Eigen::all), own.eyes);
  return judge_region(V, moved, used.F(list_marked(changed), Eigen::all), frame, own, length, progress);
}

}  // namespace

WorsePlace judge_change(const Positions& before, const Positions& after, const Triangles& F,
                        const Vector3& view_direction, const LightSet& lights, double length,
                        const std::shared_ptr<Progress>& progress) {
  check(before, after, F, lights, length);
  const auto result = std::make_shared<WorsePlace>();
  run_abandonable(progress.get(),
                  [=] { *result = judge(before, after, F, view_direction, lights, length, progress.get()); });
  return *result;
}

WorsePlace judge_change(const ShapeOptimizer& optimizer, const LightSet& lights, double length,
                        const std::shared_ptr<Progress>& progress) {
  return judge_change(optimizer.start(), optimizer.positions(), optimizer.triangles(), optimizer.frame().z(), lights,
                      length, progress);
}

}  // namespace reflines
