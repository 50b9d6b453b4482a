#include "inspection/gap_probe.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/mesh.h"

namespace reflines {
namespace {

constexpr double kLayers = 8.0;   // mean edges of the border beyond the gap, within which the other side is fitted
constexpr double kTilted = 0.87;  // cosine of 30 degrees
constexpr double kClosed = 1e-3;  // of an edge's length: a gap too narrow to have a direction
constexpr double kTaper = 0.9;    // cosine of 26 degrees, by which rims are at most not parallel
constexpr double kUpright = 0.1;  // largest cosine between the way across and the other rim: more is beyond its end

}  // namespace

struct GapProbe::Stand {
  const BorderEdge& edge;
  Vector3 at, normal, outward;
  double length;
};

GapProbe::GapProbe(const Positions& V, const Triangles& F, const Surroundings& around, const Positions& V_beside,
                   const Triangles& F_beside, double gap, const LinesAcross* lines)
    : V_(V), gap_(gap), lines_(lines), border_(find_open_border(V, F, around)) {
  if (border_.edges.empty() || F_beside.rows() == 0) {
    border_.edges.clear();
    return;
  }
  own_.V = V;
  own_.F = F;
  own_.neighbors = edge_neighbors(F);
  own_rim_.emplace(own_.V, own_.F, own_.neighbors, list_marked(Mask::Constant(F.rows(), true)));
  find_neighbor_sheets(V, border_, V_beside, F_beside, gap + kLayers * border_.edge, sheets_);
  for (const Sheet& sheet : sheets_.list) rims_.emplace_back(sheets_.V, sheets_.F, sheets_.neighbors, sheet.triangles);
}

std::optional<GapPlace> GapProbe::measure(const BorderEdge& edge) const {
  const Vector3 n = (border_.normal.row(edge.first) + border_.normal.row(edge.second)).normalized();
  const Vector3 along = V_.row(edge.second) - V_.row(edge.first);
  const Stand stand{edge, own_rim_->piece(edge.first, edge.second).at(0.5), n, along.cross(n).normalized(),
                    along.norm()};
  std::optional<GapPlace> best;
  for (int k = 0; k < static_cast<int>(rims_.size()); ++k) {
    const std::optional<GapPlace> found = probe(stand, k);
    if (found && (!best || found->distance < best->distance)) best = found;
  }
  return best;
}

std::optional<GapPlace> GapProbe::probe(const Stand& stand, int sheet) const {
  const double within = std::numbers::sqrt2 * gap_;  // as wide as it may be, and as high
  const Sheet& own = sheets_.list[sheet];
  if (own.box.squaredExteriorDistance(stand.at) > within * within) return std::nullopt;
  const std::optional<RimFoot> foot = rims_[sheet].find(stand.at, within);
  if (!foot || own.overlaps(stand.at, stand.outward, std::max(gap_, 0.5 * border_.edge))) return std::nullopt;
  std::optional<GapPlace> place = compare(stand, *foot);
  if (!place) return std::nullopt;
  place->sheet = sheet;
  place->source = sheets_.source[foot->triangle];
  place->distance = foot->distance;
  return place;
}

// Measures towards a foot on the other rim, with both sides fitted over the plane across their mean normal.
std::optional<GapPlace> GapProbe::compare(const Stand& stand, const RimFoot& foot) const {
  const Vector3 middle = 0.5 * (stand.at + foot.place);
  Vector3 normal = stand.normal;
  std::optional<SheetPoint> own, other;
  for (int pass = 0; pass < 2; ++pass) {
    own = fit_sheet(own_, stand.edge.triangle, middle, normal);
    other = fit_sheet(sheets_, foot.triangle, middle, normal);
    if (!own || !other || own->normal.dot(other->normal) < kTilted) return std::nullopt;
    normal = (own->normal + other->normal).normalized();
  }
  const Vector3 between = foot.place - stand.at, across = between - normal * normal.dot(between);
  GapPlace place;
  place.gap = across.norm();
  place.flush = (other->place - own->place).dot(normal);
  if (place.gap > gap_ || std::abs(place.flush) > gap_) return std::nullopt;
  const bool is_wide = place.gap > kClosed * stand.length;
  if (is_wide && across.dot(stand.outward) < kTaper * place.gap) return std::nullopt;
  if (is_wide && std::abs(across.dot(foot.along)) > kUpright * place.gap) return std::nullopt;
  place.kink =
      std::atan2(own->normal.cross(other->normal).norm(), own->normal.dot(other->normal)) * 180 / std::numbers::pi;
  if (lines_) place.lines = lines_->compare(*own, *other);
  return place;
}

}  // namespace reflines
