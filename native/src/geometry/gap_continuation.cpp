#include "reflines/gap_continuation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel_failure.h"
#include "geometry/bounding_box.h"
#include "geometry/neighbor_sheets.h"
#include "geometry/open_border.h"
#include "geometry/sheet_fit.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr double kMostFlush = 0.3;  // of the widest gap
constexpr double kTilted = 0.985;   // cosine of 10 degrees: what is bent more is a design's edge
constexpr double kBent = 0.87;      // cosine of 30 degrees, from ring to ring
constexpr double kGrowth = 1.15;    // of the rings' width
constexpr int kMostRings = 24;
constexpr double kFlat = 0.05;  // least area of a triangle of the rings, of the square of its longest edge

// The side of a gap across from a border vertex.
struct Contact {
  int sheet = -1;
  double distance = std::numeric_limits<double>::infinity();
  double width = 0, flush = 0;
  SheetPoint point = {};
};

struct Search {
  const Positions& V;
  const OpenBorder& border;
  const NeighborSheets& sheets;
  double gap;

  Vector3 at(int v) const { return V.row(v); }
  Vector3 normal(int v) const { return border.normal.row(v); }
  Vector3 outward(int v) const { return border.outward.row(v); }
};

bool overlaps(const Search& search, const Sheet& sheet, int v) {
  return sheet.overlaps(search.at(v), search.outward(v), std::max(search.gap, 0.5 * search.border.edge));
}

// Returns the contact of a border vertex with one sheet, where that is its neighbour.
std::optional<Contact> touch(const Search& search, int k, int v) {
  const Sheet& sheet = search.sheets.list[k];
  const Vector3 at = search.at(v), n = search.normal(v);
  if (sheet.box.squaredExteriorDistance(at) > search.gap * search.gap) return std::nullopt;
  const NearestPoint nearest = sheet.surface.find(at, search.gap);
  if (nearest.triangle < 0 || overlaps(search, sheet, v)) return std::nullopt;
  const std::optional<SheetPoint> point = fit_sheet(search.sheets, nearest.triangle, at, n);
  if (!point || point->normal.dot(n) < kTilted) return std::nullopt;
  const double flush = (point->place - at).dot(n);
  if (std::abs(flush) > kMostFlush * search.gap) return std::nullopt;
  const Vector3 d = nearest.point - at;
  return Contact{k, d.norm(), (d - n * n.dot(d)).norm(), flush, *point};
}

// Returns the contacts of a border vertex, the nearest first.
std::vector<Contact> list_contacts(const Search& search, int v) {
  std::vector<Contact> contacts;
  for (int k = 0; k < static_cast<int>(search.sheets.list.size()); ++k) {
    if (const std::optional<Contact> contact = touch(search, k, v)) contacts.push_back(*contact);
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& one, const Contact& other) { return one.distance < other.distance; });
  return contacts;
}

// Follows the sheet outwards from a border vertex; returns the places of the rings, moved by the step.
std::vector<Vector3> follow(const Search& search, const Contact& contact, int v, double margin) {
  std::vector<Vector3> rings;
  SheetPoint from = contact.point;
  Vector3 outward = search.outward(v);
  double width = search.border.edge, travelled = 0;
  const NearestSurface& surface = search.sheets.list[contact.sheet].surface;
  while (travelled < margin && rings.size() < kMostRings) {
    outward = (outward - outward.dot(from.normal) * from.normal).normalized();
    const Vector3 at = from.place + width * outward;
    const double within = travelled + width < contact.width + search.border.edge ? search.gap : 0.0;
    const NearestPoint nearest = surface.find(at, std::max(within, 0.3 * width));
    if (nearest.triangle < 0) break;
    const std::optional<SheetPoint> point = fit_sheet(search.sheets, nearest.triangle, at, from.normal);
    if (!point || point->normal.dot(from.normal) < kBent || (point->place - at).norm() > 0.5 * width) break;
    rings.push_back(point->place - contact.flush * point->normal);
    from = *point;
    travelled += width;
    width *= kGrowth;
  }
  return rings;
}

// The rings being built: the numbers of their vertices in the columns that begin at border vertices.
struct Rings {
  std::vector<std::vector<int>> column;  // #V, the border vertex first
  std::vector<Vector3> places;
  std::vector<Eigen::RowVector3i> triangles;
};

Vector3 find_place(const Positions& V, const Rings& rings, int v) {
  return v < V.rows() ? Vector3(V.row(v)) : rings.places[v - V.rows()];
}

// Adds a triangle unless it is folded over or flat; returns whether it was.
bool add_triangle(const Positions& V, const Vector3& normal, int a, int b, int c, Rings& rings) {
  const Vector3 p = find_place(V, rings, a), q = find_place(V, rings, b), r = find_place(V, rings, c);
  const double longest = std::max({(q - p).squaredNorm(), (r - p).squaredNorm(), (r - q).squaredNorm()});
  if ((q - p).cross(r - p).dot(normal) < kFlat * longest) return false;
  rings.triangles.emplace_back(a, b, c);
  return true;
}

// Adds the triangles beyond one border edge; returns whether the first ring is whole there.
bool add_strip(const Search& search, const BorderEdge& edge, Rings& rings) {
  const std::vector<int>&one = rings.column[edge.first], &other = rings.column[edge.second];
  const Vector3 n = search.normal(edge.first);
  bool first = false;
  for (size_t k = 0; k + 1 < std::min(one.size(), other.size()); ++k) {
    const bool added = add_triangle(search.V, n, other[k], one[k], one[k + 1], rings) &&
                       add_triangle(search.V, n, other[k], one[k + 1], other[k + 1], rings);
    if (!added) break;
    first = true;
  }
  return first;
}

GapContinuation start_result(const Positions& V, double gap) {
  GapContinuation result;
  result.followed = Mask::Constant(V.rows(), false);
  result.width = result.flush = Vector::Zero(V.rows());
  result.gap = gap;
  return result;
}

void check(const Positions& V, const Positions& V_beside, const Triangles& F_beside, const GapOptions& options) {
  if (!(options.gap >= 0) || !(options.margin >= 0) || !std::isfinite(options.gap) || !std::isfinite(options.margin))
    throw InvalidInput("The gap and the margin must be positive lengths, or 0 for automatic.");
  if (!V.allFinite()) throw InvalidInput("A coordinate of the region is not finite.");
  if (F_beside.size() > 0 && (F_beside.minCoeff() < 0 || F_beside.maxCoeff() >= V_beside.rows())) {
    throw InvalidInput("The triangles beside the region name a vertex beyond the " + std::to_string(V_beside.rows()) +
                       " that there are.");
  }
}

// Moves the rings' triangles and vertices into the result, and marks what is followed.
void finish(const Search& search, const std::vector<Contact>& contacts, const Mask& broken, const Rings& rings,
            GapContinuation& result) {
  result.around.V.resize(static_cast<Eigen::Index>(rings.places.size()), 3);
  for (size_t k = 0; k < rings.places.size(); ++k)
    result.around.V.row(static_cast<Eigen::Index>(k)) = rings.places[k].transpose();
  result.around.F.resize(static_cast<Eigen::Index>(rings.triangles.size()), 3);
  for (size_t k = 0; k < rings.triangles.size(); ++k)
    result.around.F.row(static_cast<Eigen::Index>(k)) = rings.triangles[k];
  result.followed = search.border.vertices && !search.border.elsewhere && !broken;
  for (Eigen::Index v = 0; v < result.followed.size(); ++v) {
    if (!result.followed(v)) continue;
    result.width(v) = contacts[v].width;
    result.flush(v) = contacts[v].flush;
  }
}

}  // namespace

GapContinuation continue_over_gap(const Positions& V, const Triangles& F, const Surroundings& around,
                                  const Positions& V_beside, const Triangles& F_beside, const GapOptions& options) {
  check(V, V_beside, F_beside, options);
  const double gap = options.gap > 0 ? options.gap : kAutomaticGap * bounding_box_diagonal(V);
  const double margin = std::max(options.margin, gap);
  GapContinuation result = start_result(V, gap);
  const OpenBorder border = find_open_border(V, F, around);
  if (border.edges.empty() || F_beside.rows() == 0) return result;
  NeighborSheets sheets;
  find_neighbor_sheets(V, border, V_beside, F_beside, gap + margin, sheets);
  const Search search{V, border, sheets, gap};
  std::vector<Contact> contacts(V.rows());
  std::vector<std::vector<Vector3>> places(V.rows());
  run_parallel(static_cast<int>(V.rows()), 16, [&](int v) {
    if (!border.vertices(v)) return;
    for (const Contact& contact : list_contacts(search, v)) {  // at a corner one of several may not lie outwards
      contacts[v] = contact;
      places[v] = follow(search, contact, v, margin);
      if (!places[v].empty()) break;
    }
  });
  Rings rings{std::vector<std::vector<int>>(V.rows()), {}, {}};
  for (int v = 0; v < static_cast<int>(V.rows()); ++v) {
    rings.column[v] = {v};
    for (const Vector3& place : places[v]) {
      rings.column[v].push_back(static_cast<int>(V.rows() + rings.places.size()));
      rings.places.push_back(place);
    }
  }
  Mask broken = Mask::Constant(V.rows(), false);
  for (const BorderEdge& edge : border.edges) {
    if (!add_strip(search, edge, rings)) broken(edge.first) = broken(edge.second) = true;
  }
  finish(search, contacts, broken, rings, result);
  return result;
}

}  // namespace reflines
