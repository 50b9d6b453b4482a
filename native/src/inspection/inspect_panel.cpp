#include "reflines/inspect_panel.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "geometry/bounding_box.h"
#include "geometry/centroids.h"
#include "geometry/height_field.h"
#include "geometry/mesh.h"
#include "geometry/sight.h"
#include "inspection/line_deviation.h"
#include "inspection/peaks.h"
#include "inspection/reference_surface.h"
#include "reflines/errors.h"
#include "restoration/used_vertices.h"
#include "solver/families.h"
#include "threads/abandonable_work.h"

namespace reflines {
namespace {

// Radius of the mean, relative to the length: a flaw counts as one place, and the facets of a mesh are none.
constexpr double kRadius = 0.35;

constexpr double kLooking = 0.5;  // of the work, for the bar of its progress

constexpr double kLongest = 1e3;  // length, relative to the diagonal

void check_directions(const Positions& directions, const std::string& name) {
  if (directions.rows() == 0) throw InvalidInput("There is no " + name + " direction; give one or more.");
  for (Eigen::Index k = 0; k < directions.rows(); ++k) {
    if (directions.row(k).allFinite() && !directions.row(k).isZero(0)) continue;
    throw InvalidInput("The direction of " + name + " " + std::to_string(k) +
                       " has no length or is not a number; give three finite numbers.");
  }
}

// Throws where a light is parallel to a view, with the names of both.
void check_pairs(const Positions& views, const Positions& lines, const InspectOptions& options) {
  check_directions(views, "view");
  check_directions(lines, "light");
  const auto& pairs = options.pairs;
  if (pairs.size() > 0 && (pairs.rows() != views.rows() || pairs.cols() != lines.rows() || !pairs.any())) {
    throw InvalidInput("The pairs that are looked at need a row for each of the " + std::to_string(views.rows()) +
                       " views and a column for each of the " + std::to_string(lines.rows()) +
                       " lights, and one of them at least.");
  }
  for (Eigen::Index k = 0; k < views.rows(); ++k) {
    for (Eigen::Index l = 0; l < lines.rows(); ++l) {
      if (pairs.size() > 0 && !pairs(k, l)) continue;
      try {
        const ImagePlane plane(views.row(k), lines.row(l));
      } catch (const InvalidInput&) {
        throw InvalidInput("Light " + std::to_string(l) + " is parallel to view " + std::to_string(k) +
                           ", so no reflection lines can be seen; turn one of them.");
      }
    }
  }
}

std::vector<Vector3> rows_of(const Positions& points) {
  std::vector<Vector3> result;
  for (Eigen::Index k = 0; k < points.rows(); ++k) result.emplace_back(points.row(k));
  return result;
}

void check_options(const InspectOptions& options) {
  const auto refuse = [](const char* what) { throw InvalidInput(what); };
  if (!(options.length >= 0) || !std::isfinite(options.length))
    refuse("The length must be a positive length, or 0 for automatic.");
  if (!(options.flaw_size > 0) || !std::isfinite(options.flaw_size)) refuse("The flaw size must be a number above 0.");
  if (!(options.noise_floor >= 0)) refuse("The noise floor must be 0 or more degrees.");
  if (options.most_spots < 0) refuse("The number of spots must be 0 or more.");
  if (!options.blocker_vertices.allFinite()) refuse("A vertex of what may hide the panel is no finite number.");
  check_indices(options.blocker_vertices, options.blockers);
}

// The panel's own vertices and triangles, with what may hide them after these.
struct Scene {
  Positions V;
  Triangles F;
  int own_vertices, own_triangles;

  auto panel_vertices() const { return V.topRows(own_vertices); }
  auto panel() const { return F.topRows(own_triangles); }
  Vector3 cross(int t) const { return area_normal(V, F, t); }
};

Scene make_scene(const Positions& V, const UsedVertices& used, const InspectOptions& options) {
  const auto count = static_cast<int>(used.index.size());
  Scene scene{Positions(count + options.blocker_vertices.rows(), 3),
              Triangles(used.F.rows() + options.blockers.rows(), 3), count, static_cast<int>(used.F.rows())};
  scene.V << V(used.index, Eigen::all), options.blocker_vertices;
  scene.F << used.F, options.blockers.array() + count;
  return scene;
}

HeightField make_field(const Scene& scene, const ImagePlane& frame) {
  const Boundary boundary{std::vector<Border>(scene.own_vertices, Border::kFixed), {}, {.rule = CreaseRule::kNone}};
  return make_height_field(scene.panel_vertices(), scene.panel(), frame, boundary);
}

LineDeviation look_around(const Scene& scene, const HeightField& field, const ImagePlane& frame,
                          const PlaneVectors& course, double length, const Positions& views, const Positions& lines,
                          const InspectOptions& options) {
  DeviationSum sum(field, frame, course, kRadius * length, options.keep_maps);
  for (Eigen::Index k = 0; k < views.rows(); ++k) {
    const double done = static_cast<double>(k) / static_cast<double>(views.rows());
    if (options.progress) options.progress->enter(kLooking + (1 - kLooking) * done, "looking from each view");
    const Vector3 view = views.row(k).transpose().stableNormalized();
    const Eigen::ArrayX<bool> counts = options.pairs.size() > 0 ? Eigen::ArrayX<bool>(options.pairs.row(k).transpose())
                                                                : Eigen::ArrayX<bool>::Constant(lines.rows(), true);
    const bool looks = counts.any();
    sum.add_view(view, lines, counts,
                 looks ? weigh_sight(scene.V, scene.F, field.source, view) : Vector(Vector::Zero(field.area.size())));
  }
  return sum.result();
}

WorstSpot make_spot(const Peak& peak, const Scene& scene, const HeightField& field, const LineDeviation& deviation,
                    const Vector& flaws, const Vector3& axis) {
  WorstSpot spot{.place = find_centroid(scene.V, scene.F, field.source[peak.top]),
                 .degrees = deviation.worst(peak.top),
                 .view = deviation.view(peak.top),
                 .light = deviation.light(peak.top),
                 .front_light = deviation.front_light(peak.top),
                 .triangles = {}};
  double area = 0;
  for (const int t : peak.triangles) {
    const Vector3 cross = scene.cross(field.source[t]);
    area += 0.5 * cross.norm();
    spot.triangles.push_back(field.source[t]);
    for (int i = 0; i < 3; ++i) {
      const double height = flaws(field.F(t, i)) * cross.normalized().dot(axis);
      if (std::abs(height) > std::abs(spot.height)) spot.height = height;
    }
  }
  spot.size = 2 * std::sqrt(area / std::numbers::pi);
  return spot;
}

// Fills in what is reported of all lights and views together: of the pairs that are looked at, from views that see it.
void sum_up(PanelInspection& result, const InspectOptions& options) {
  Eigen::ArrayXXd counts = Eigen::ArrayXXd::Ones(result.degrees.rows(), result.degrees.cols());
  if (options.pairs.size() > 0) counts = options.pairs.cast<double>();
  counts.colwise() *= (result.seen.array() > 0).cast<double>();
  if (counts.sum() == 0) return;
  const Eigen::ArrayXXd degrees = result.degrees.array() * counts;
  result.mean = degrees.sum() / counts.sum();
  (degrees.rowwise().sum() / counts.rowwise().sum().max(1.0)).maxCoeff(&result.worst_view);
  (degrees.colwise().sum() / counts.colwise().sum().max(1.0)).maxCoeff(&result.worst_light);
}

// Spreads the deviations of a field's triangles over those of the panel.
void spread(const LineDeviation& deviation, const std::vector<int>& source, Eigen::Index triangles,
            PanelInspection& result) {
  result.degrees = deviation.degrees;
  result.seen = deviation.seen;
  result.deviation = Vector::Zero(triangles);
  result.view = result.light = IndexVector::Zero(triangles);
  result.deviation(source) = deviation.worst;
  result.view(source) = deviation.view;
  result.light(source) = deviation.light;
  if (deviation.maps.cols() == 0) return;
  result.maps = Eigen::MatrixXf::Zero(triangles, deviation.maps.cols());
  result.maps(source, Eigen::all) = deviation.maps;
}

PanelInspection inspect(const Positions& V, const Triangles& F, const Positions& views, const Positions& lines,
                        const InspectOptions& options) {
  const UsedVertices used = find_used_vertices(F, static_cast<int>(V.rows()));
  const Scene scene = make_scene(V, used, options);
  const std::vector<Vector3> axes = rows_of(lines);
  const ImagePlane frame =
      choose_frame(views.row(0), axes, {.directions = axes, .blocker_vertices = {}, .blockers = {}});
  const HeightField field = make_field(scene, frame);
  PanelInspection result;
  const double diagonal = bounding_box_diagonal(scene.panel_vertices());
  result.length = std::min(options.length > 0 ? options.length : options.flaw_size * kAutomaticLength * diagonal,
                           kLongest * diagonal);
  const ReferenceSurface reference = find_reference_surface(field, result.length, options.progress.get());
  const LineDeviation deviation =
      look_around(scene, field, frame, reference.slopes, result.length, views, lines, options);
  spread(deviation, field.source, F.rows(), result);
  result.height = Vector::Zero(V.rows());
  result.height(used.index) = reference.flaws;
  for (const Peak& peak : find_peaks(deviation.worst, field.neighbors, options.noise_floor)) {
    if (static_cast<int>(result.spots.size()) == options.most_spots) break;
    result.spots.push_back(make_spot(peak, scene, field, deviation, reference.flaws, frame.z()));
  }
  sum_up(result, options);
  return result;
}

}  // namespace

PanelInspection inspect_panel(const Positions& V, const Triangles& F, const Positions& views, const Positions& lines,
                              const InspectOptions& options) {
  check_options(options);
  check_pairs(views, lines, options);
  check_surface(V, F);
  const auto result = std::make_shared<PanelInspection>();
  run_abandonable(options.progress.get(), [=] { *result = inspect(V, F, views, lines, options); });
  return std::move(*result);
}

}  // namespace reflines
