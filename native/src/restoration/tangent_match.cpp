#include "restoration/tangent_match.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

#include "base/smoothstep.h"
#include "base/sort_unique.h"
#include "geometry/height_fit.h"
#include "geometry/mesh.h"
#include "restoration/press_rules.h"
#include "restoration/rim_spread.h"

namespace reflines {
namespace {

// The largest of r (1 - r^2)^3, the course of the change over the distance.
constexpr double kHighest = 0.238;

// The joined mesh over the image plane.
struct Plane {
  PlanePositions xy;
  Vector z;
  Incidence triangles_of_vertex;
};

Plane place(const TangentMatch& match, const Vector& move) {
  Plane plane{match.frame.project(match.joined.V), match.frame.heights(match.joined.V), {}};
  plane.z.head(match.vertices) += move;
  plane.triangles_of_vertex = vertex_triangles(match.joined.F, static_cast<int>(match.joined.V.rows()));
  return plane;
}

// Returns the vertices of one side of a border vertex, itself among them.
std::vector<int> gather_side(const TangentMatch& match, const Plane& plane, int v, bool inside) {
  std::vector<int> found = {v};
  for (int ring = 0; ring < kRules.border.slope_rings; ++ring) {
    for (const int w : std::vector<int>(found)) {
      for (int e = plane.triangles_of_vertex.begin(w); e < plane.triangles_of_vertex.end(w); ++e) {
        const int t = plane.triangles_of_vertex.items[e];
        if ((t < match.triangles) != inside) continue;
        for (const int corner : match.joined.F.row(t)) found.push_back(corner);
      }
    }
    sort_unique(found);
  }
  return found;
}

HeightFit fit_side(const TangentMatch& match, const Plane& plane, int v, bool inside) {
  const std::vector<int> side = gather_side(match, plane, v, inside);
  if (side.size() < 2) return {};
  const PlanePositions points = plane.xy(side, Eigen::all).rowwise() - plane.xy.row(v);
  return fit_heights(points, plane.z(side));
}

// The followed border: its edges as triangles without area, and by how much slopes differ across it.
struct Rim {
  Triangles edges;    // first, second, second
  Positions outward;  // #vertices x 3, in the image plane
  Vector slope;       // #vertices: by how much it is to grow outwards
  Vector from_end;    // #vertices: distance along the border to where it is no longer followed
};

Rim find_rim(const TangentMatch& match, const Plane& plane) {
  const Triangles F = match.joined.F.topRows(match.triangles), border = find_border_edges(F, edge_neighbors(F));
  std::vector<int> followed;
  Rim rim{{}, Positions::Zero(match.vertices, 3), Vector::Zero(match.vertices), {}};
  for (int k = 0; k < border.rows(); ++k) {
    const int a = border(k, 0), b = border(k, 1);
    if (match.border[a] != Border::kFollow && match.border[b] != Border::kFollow) continue;
    followed.push_back(k);
    const Vector2 along = (plane.xy.row(b) - plane.xy.row(a)).transpose().normalized();
    const Eigen::RowVector3d across(along.y(), -along.x(), 0);
    rim.outward.row(a) += across;
    rim.outward.row(b) += across;
  }
  rim.edges = border(followed, Eigen::all);
  return rim;
}

// Hands distances on along the border from the ends of what is followed.
void measure_from_ends(const TangentMatch& match, const Plane& plane, Rim& rim) {
  rim.from_end = Vector::Constant(match.vertices, std::numeric_limits<double>::infinity());
  std::vector<std::vector<int>> near(match.vertices);
  std::queue<int> open;
  for (Eigen::Index k = 0; k < rim.edges.rows(); ++k) {
    const int a = rim.edges(k, 0), b = rim.edges(k, 1);
    near[a].push_back(b);
    near[b].push_back(a);
    for (const int v : {a, b}) {
      if (match.border[v] == Border::kFollow || rim.from_end(v) == 0) continue;
      rim.from_end(v) = 0;
      open.push(v);
    }
  }
  while (!open.empty()) {
    const int v = open.front();
    open.pop();
    for (const int w : near[v]) {
      const double distance = rim.from_end(v) + (plane.xy.row(w) - plane.xy.row(v)).norm();
      if (distance >= rim.from_end(w)) continue;
      rim.from_end(w) = distance;
      open.push(w);
    }
  }
}

void measure_slopes(const TangentMatch& match, const Plane& plane, Rim& rim) {
  const auto count = static_cast<int>(match.vertices);
  for (int v = 0; v < count; ++v) {
    if (match.border[v] != Border::kFollow || rim.outward.row(v).isZero(0)) continue;
    const HeightFit in = fit_side(match, plane, v, true), out = fit_side(match, plane, v, false);
    if (in.degree == 0 || out.degree == 0) continue;
    const Vector2 across = rim.outward.row(v).head<2>().transpose().normalized();
    rim.slope(v) = (out.slope - in.slope).dot(across) * (match.fraction.size() > 0 ? match.fraction(v) : 1);
  }
}

void average_slopes(const TangentMatch& match, Rim& rim) {
  for (int pass = 0; pass < kRules.border.slope_averages; ++pass) {
    Vector sum = 2 * rim.slope, weight = Vector::Constant(rim.slope.size(), 2);
    for (Eigen::Index k = 0; k < rim.edges.rows(); ++k) {
      const int a = rim.edges(k, 0), b = rim.edges(k, 1);
      if (match.border[a] != Border::kFollow || match.border[b] != Border::kFollow) continue;
      sum(a) += rim.slope(b);
      sum(b) += rim.slope(a);
      weight(a) += 1;
      weight(b) += 1;
    }
    rim.slope = sum.cwiseQuotient(weight);
  }
}

Vector3 find_normal(const PlanePositions& xy, const Vector& z, const Triangles& F, Eigen::Index t) {
  const auto place = [&](int v) { return Vector3(xy(v, 0), xy(v, 1), z(v)); };
  const Vector3 a = place(F(t, 0));
  return (place(F(t, 1)) - a).cross(place(F(t, 2)) - a);
}

}  // namespace

double find_turn(const TangentMatch& match, const Vector& change) {
  const PlanePositions xy = match.frame.project(match.joined.V);
  const Vector before = match.frame.heights(match.joined.V);
  Vector after = before;
  after.head(match.vertices) += change;
  double largest = 0;
  for (Eigen::Index t = 0; t < match.triangles; ++t) {
    const auto& corners = match.joined.F.row(t);
    const auto follows = [&](int v) { return match.border[v] == Border::kFollow; };
    if (!std::any_of(corners.begin(), corners.end(), follows)) continue;
    const Vector3 one = find_normal(xy, before, match.joined.F, t), other = find_normal(xy, after, match.joined.F, t);
    largest = std::max(largest, std::atan2(one.cross(other).norm(), one.dot(other)));
  }
  return largest * 180 / std::numbers::pi;
}

Vector match_tangents(const TangentMatch& match, const Vector& move, double width, double limit) {
  const Plane plane = place(match, move);
  Rim rim = find_rim(match, plane);
  if (rim.edges.rows() == 0) return Vector::Zero(match.vertices);
  measure_from_ends(match, plane, rim);
  measure_slopes(match, plane, rim);
  average_slopes(match, rim);
  for (Eigen::Index v = 0; v < rim.slope.size(); ++v) {
    if (rim.slope(v) != 0) rim.slope(v) *= smoothstep(0, 0.5 * width, rim.from_end(v));
  }
  const double steepest = rim.slope.cwiseAbs().maxCoeff();
  const double within = steepest > 0 ? std::min(width, limit / (kHighest * steepest)) : width;
  return spread_from_rim(plane.xy.topRows(match.vertices), rim.edges, rim.slope, within,
                         [&](double distance) { return -distance * fade(distance / within); });
}

}  // namespace reflines
