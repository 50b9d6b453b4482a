#include "solver/families.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

#include "geometry/mesh.h"
#include "geometry/sight.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

// Returns the image plane of two directions, nothing where they span none.
std::optional<ImagePlane> try_plane(const Vector3& view, const Vector3& line) {
  try {
    return ImagePlane(view, line);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

void check_eyes(const std::vector<Vector3>& line_directions, const Eyes& eyes) {
  const auto refuse = [](const std::string& what) { throw InvalidInput(what); };
  if (eyes.directions.size() != line_directions.size()) {
    refuse("There are " + std::to_string(eyes.directions.size()) + " eye directions for " +
           std::to_string(line_directions.size()) + " line directions; give one for each family, or none.");
  }
  for (size_t k = 0; k < line_directions.size(); ++k) {
    const Vector3 &eye = eyes.directions[k], &line = line_directions[k];
    if (!eye.allFinite() || eye.isZero(0))
      refuse("Eye direction " + std::to_string(k) + " has no length or is not a number; give three finite numbers.");
    if (!line.allFinite() || line.isZero(0))
      refuse("Line direction " + std::to_string(k) + " has no length or is not a number; give three finite numbers.");
    if (!try_plane(eye, line)) {
      refuse("Light lines " + std::to_string(k) + " are parallel to eye direction " + std::to_string(k) +
             ", so no reflection lines can be seen; turn one of them.");
    }
  }
  if (!eyes.blocker_vertices.allFinite()) refuse("A vertex of what may hide the region is no finite number.");
  check_indices(eyes.blocker_vertices, eyes.blockers);
}

// A region with what may hide it after it.
struct Scene {
  Positions V;
  Triangles F;
  std::vector<int> region;  // its triangles
};

Scene make_scene(const Positions& V, const Triangles& F, const Eyes& eyes) {
  Scene scene{Positions(V.rows() + eyes.blocker_vertices.rows(), 3), Triangles(F.rows() + eyes.blockers.rows(), 3),
              std::vector<int>(F.rows())};
  scene.V << V, eyes.blocker_vertices;
  scene.F << F, eyes.blockers.array() + static_cast<int>(V.rows());
  std::iota(scene.region.begin(), scene.region.end(), 0);
  return scene;
}

// Weighs what each eye sees (#F); families with the same eye do it once.
std::vector<Vector> weigh_eyes(const Positions& V, const Triangles& F, const Eyes& eyes) {
  const Scene scene = make_scene(V, F, eyes);
  std::vector<Vector3> eye;
  std::vector<Vector> result;
  for (const Vector3& direction : eyes.directions) {
    const Vector3 unit = direction.stableNormalized();
    const auto same = std::find(eye.begin(), eye.end(), unit);
    result.push_back(same != eye.end() ? result[same - eye.begin()]
                                       : weigh_sight(scene.V, scene.F, scene.region, unit));
    eye.push_back(unit);
  }
  return result;
}

}  // namespace

ImagePlane choose_frame(const Vector3& view_direction, const std::vector<Vector3>& line_directions, const Eyes& eyes) {
  if (line_directions.empty())
    throw InvalidInput("There is no family of light lines; give at least one line direction.");
  if (const auto plane = try_plane(view_direction, eyes.frame_line)) return *plane;
  if (eyes.exist() && view_direction.allFinite() && !view_direction.isZero(0)) {
    for (const Vector3& line : line_directions) {
      if (const auto plane = try_plane(view_direction, line)) return *plane;
    }
    return {view_direction, view_direction.unitOrthogonal()};
  }
  return {view_direction, line_directions.front()};
}

Families make_families(const Positions& V, const Triangles& F, const ImagePlane& frame,
                       const std::vector<Vector3>& line_directions, const Eyes& eyes) {
  if (eyes.exist()) check_eyes(line_directions, eyes);
  Families result;
  for (size_t k = 0; k < line_directions.size(); ++k)
    result.lines.emplace_back(frame, eyes.exist() ? eyes.directions[k] : frame.z(), line_directions[k]);
  result.lines.emplace_back(frame, frame.z(), frame.x());
  if (eyes.exist()) result.sight = weigh_eyes(V, F, eyes);
  return result;
}

bool see_nothing(const Families& families) {
  return !families.sight.empty() &&
         std::all_of(families.sight.begin(), families.sight.end(), [](const Vector& sight) { return sight.isZero(0); });
}

}  // namespace reflines
