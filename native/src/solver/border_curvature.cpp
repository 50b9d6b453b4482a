#include "solver/border_curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <utility>

#include "geometry/height_fit.h"
#include "reflection/element.h"

namespace reflines {
namespace {

constexpr int kRings = 3;            // of the surroundings that a fit takes in
constexpr double kReachEdges = 6.0;  // mean edges that the pull reaches at least
constexpr double kReachShare = 0.1;  // of the region's diagonal that it reaches at least
constexpr int kAverages = 2;         // passes along the border, which take the noise out of the fits

// The surroundings over the image plane, in the coordinates of the region's height field.
struct Beside {
  PlanePositions xy;  // of the region's vertices, then of their own
  Vector z;
  Triangles F;  // those that face the viewer
  Incidence triangles_of_vertex;
};

Beside place_surroundings(const Positions& V, const HeightField& field, const Surroundings& around,
                          const ImagePlane& frame) {
  Positions all(V.rows() + around.V.rows(), 3);
  all << V, around.V;
  Beside beside;
  beside.xy = frame.project(all);
  beside.z = frame.heights(all);
  const int known = field.F(0, 0);  // of no face a vertex may lie anywhere
  const Eigen::RowVector2d shift = field.xy.row(known) - beside.xy.row(known);
  beside.xy.rowwise() += shift;
  beside.z.array() += field.z(known) - beside.z(known);
  beside.F.resize(around.F.rows(), 3);
  int count = 0;
  for (int t = 0; t < around.F.rows(); ++t) {
    const Vector3 a = all.row(around.F(t, 0)), b = all.row(around.F(t, 1)), c = all.row(around.F(t, 2));
    const Vector3 n = (b - a).cross(c - a);
    if (n.dot(frame.z()) > kSilhouette * n.norm()) beside.F.row(count++) = around.F.row(t);
  }
  beside.F.conservativeResize(count, 3);
  beside.triangles_of_vertex = vertex_triangles(beside.F, static_cast<int>(all.rows()));
  return beside;
}

void sort_unique(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Returns the vertices of the surroundings within kRings rings of a vertex, itself among them.
std::vector<int> gather_rings(const Beside& beside, int v) {
  std::vector<int> found = {v};
  for (int ring = 0; ring < kRings; ++ring) {
    for (size_t k = 0, n = found.size(); k < n; ++k) {
      const Incidence& around = beside.triangles_of_vertex;
      for (int e = around.begin(found[k]); e < around.end(found[k]); ++e) {
        const int t = around.items[e];
        found.insert(found.end(), {beside.F(t, 0), beside.F(t, 1), beside.F(t, 2)});
      }
    }
    sort_unique(found);
  }
  return found;
}

HeightFit fit_beside(const Beside& beside, int v) {
  const std::vector<int> vertices = gather_rings(beside, v);
  if (vertices.size() < 2) return {};
  const PlanePositions points = beside.xy(vertices, Eigen::all).rowwise() - beside.xy.row(v);
  return fit_heights(points, beside.z(vertices));
}

using Derivatives = std::map<int, Vector5>;  // by the border vertex

Derivatives fit_border(const Beside& beside, const HeightField& field, const std::vector<Border>& border,
                       int& unknown) {
  std::vector<int> wanted;
  for (int v = 0; v < field.vertex_count(); ++v) {
    const bool used = field.role[v] != VertexRole::kUnused;
    const bool has_neighbor = beside.triangles_of_vertex.end(v) > beside.triangles_of_vertex.begin(v);
    if (used && border[v] == Border::kCurvature && has_neighbor) wanted.push_back(v);
  }
  Derivatives result;
  for (const int v : wanted) {
    const HeightFit fit = fit_beside(beside, v);
    unknown += fit.degree == 0;
    if (fit.degree > 0) result[v] = (Vector5() << fit.slope, fit.second).finished();
  }
  return result;
}

// Averages the second derivatives of vertices that share an edge of the surroundings.
Derivatives average_along(const Beside& beside, const Derivatives& own) {
  Derivatives result = own;
  for (auto& [v, u] : result) {
    int count = 1;
    std::vector<int> near;
    for (int e = beside.triangles_of_vertex.begin(v); e < beside.triangles_of_vertex.end(v); ++e) {
      for (int i = 0; i < 3; ++i) near.push_back(beside.F(beside.triangles_of_vertex.items[e], i));
    }
    sort_unique(near);
    for (const int other : near) {
      const auto found = own.find(other);
      if (other == v || found == own.end()) continue;
      u.tail<3>() += found->second.tail<3>();
      ++count;
    }
    u.tail<3>() /= count;
  }
  return result;
}

double measure_mean_edge(const HeightField& field) {
  double sum = 0;
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) sum += (field.xy.row(field.F(t, i)) - field.xy.row(field.F(t, (i + 1) % 3))).norm();
  }
  return sum / (3.0 * field.triangle_count());
}

// The nearest border vertex of each triangle (#T of the field), -1 beyond the reach, and its distance.
struct Nearest {
  std::vector<int> vertex;
  Vector distance;
};

// Hands the nearest border vertex on from triangle to triangle, which creases stop.
Nearest find_nearest(const HeightField& field, const Derivatives& known, double reach) {
  Nearest nearest{std::vector<int>(field.triangle_count(), -1), Vector::Constant(field.triangle_count(), reach)};
  std::deque<int> open;
  const auto offer = [&](int t, int v) {
    const Eigen::RowVector2d centre =
        (field.xy.row(field.F(t, 0)) + field.xy.row(field.F(t, 1)) + field.xy.row(field.F(t, 2))) / 3;
    const double distance = (centre - field.xy.row(v)).norm();
    if (distance >= nearest.distance(t)) return;
    nearest.vertex[t] = v;
    nearest.distance(t) = distance;
    open.push_back(t);
  };
  for (const auto& [v, u] : known) {
    for (int e = field.triangles_of_vertex.begin(v); e < field.triangles_of_vertex.end(v); ++e)
      offer(field.triangles_of_vertex.items[e], v);
  }
  while (!open.empty()) {
    const int t = open.front();
    open.pop_front();
    for (int i = 0; i < 3; ++i) {
      if (field.neighbors(t, i) >= 0) offer(field.neighbors(t, i), nearest.vertex[t]);
    }
  }
  return nearest;
}

}  // namespace

BorderCurvature continue_curvature(const Positions& V, const HeightField& field, const std::vector<Border>& border,
                                   const Surroundings& around, const ImagePlane& frame, int triangle_count,
                                   const std::vector<ReflectionFunction>& families) {
  BorderCurvature result;
  const Beside beside = place_surroundings(V, field, around, frame);
  Derivatives known = fit_border(beside, field, border, result.unknown);
  if (known.empty()) return result;
  for (int pass = 0; pass < kAverages; ++pass) known = average_along(beside, known);
  const double edge = measure_mean_edge(field), reach = std::max(kReachEdges * edge, kReachShare * field.diagonal());
  const Nearest nearest = find_nearest(field, known, reach);
  for (const size_t k : {size_t{0}, families.size() - 1}) {
    Target target{PlaneVectors::Zero(triangle_count, 2), Vector::Zero(triangle_count), {}, static_cast<int>(k)};
    for (int t = 0; t < field.triangle_count(); ++t) {
      if (nearest.vertex[t] < 0) continue;
      const Vector5& u = known.at(nearest.vertex[t]);
      target.gradient.row(field.source[t]) = theta_gradient(families[k].derivatives(u(0), u(1), 1), u);
      const double distance = std::max(nearest.distance(t), 0.5 * edge);
      target.weight(field.source[t]) = std::pow(reach / distance - 1, 2);
    }
    result.targets.push_back(std::move(target));
  }
  return result;
}

}  // namespace reflines
