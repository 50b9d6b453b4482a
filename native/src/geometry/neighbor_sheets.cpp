#include "geometry/neighbor_sheets.h"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/mesh.h"

namespace reflines {
namespace {

constexpr double kTurned = 0.5;  // cosine of 60 degrees

// Returns the triangles (#F) that are within `distance` of the border and face as it does.
Mask find_facing(const Positions& region, const OpenBorder& border, const Positions& V, const Triangles& F,
                 double distance) {
  const Triangles points = list_points(border.vertices);
  const NearestSurface rim(region, points);
  Mask facing = Mask::Constant(F.rows(), false);
#pragma omp parallel for schedule(static) if (F.rows() > kWorthThreads)
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Vector3 a = V.row(F(t, 0)), b = V.row(F(t, 1)), c = V.row(F(t, 2)), n = (b - a).cross(c - a);
    const double far = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    if (!n.allFinite() || !(n.norm() > 0)) continue;
    const int nearest = rim.find((a + b + c) / 3, distance + far).triangle;
    facing(t) = nearest >= 0 && n.dot(border.normal.row(points(nearest, 0))) > kTurned * n.norm();
  }
  return facing;
}

// Names equal vertices of the triangles alike.
void join_doubled(const Positions& V, Triangles& F) {
  std::map<std::array<double, 3>, int> first;
  std::vector<int> name(V.rows(), -1);  // most vertices are corners of six triangles
  for (int& v : F.reshaped()) {
    if (name[v] < 0) name[v] = first.try_emplace({V(v, 0), V(v, 1), V(v, 2)}, v).first->second;
    v = name[v];
  }
}

}  // namespace

bool Sheet::overlaps(const Vector3& at, const Vector3& outward, double inside) const {
  return surface.find(at - inside * outward, 0.6 * inside).triangle >= 0;
}

void find_neighbor_sheets(const Positions& region, const OpenBorder& border, const Positions& V, const Triangles& F,
                          double distance, NeighborSheets& sheets) {
  const Mask facing = find_facing(region, border, V, F, distance);
  sheets.V = V;
  sheets.source = list_marked(facing);
  sheets.F = F(sheets.source, Eigen::all);
  join_doubled(V, sheets.F);
  sheets.neighbors = edge_neighbors(sheets.F);
  for (const std::vector<int>& triangles : find_components(sheets.neighbors)) {
    Eigen::AlignedBox3d box;
    for (const int t : triangles) {
      for (const int v : sheets.F.row(t)) box.extend(sheets.V.row(v).transpose());
    }
    sheets.list.push_back({box, NearestSurface(sheets.V, sheets.F, triangles), triangles});
  }
}

}  // namespace reflines
