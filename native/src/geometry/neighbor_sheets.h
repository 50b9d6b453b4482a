// The sheets beside a region's open border: connected surfaces that face the same way.
#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <vector>

#include "geometry/nearest_surface.h"
#include "geometry/open_border.h"
#include "reflines/types.h"

namespace reflines {

struct Sheet {
  Eigen::AlignedBox3d box;
  NearestSurface surface;
  std::vector<int> triangles;

  // Returns whether the sheet lies over or under the region, whose border is at `at` and turned to `outward`: within
  // 0.6 of `inside`, as far inside.
  bool overlaps(const Vector3& at, const Vector3& outward, double inside) const;
};

// Refers to itself: neither copied nor moved.
struct NeighborSheets {
  NeighborSheets() = default;
  NeighborSheets(const NeighborSheets&) = delete;
  NeighborSheets& operator=(const NeighborSheets&) = delete;

  Positions V;
  Triangles F, neighbors;   // across edges
  std::vector<int> source;  // #F: the triangles that were given
  std::deque<Sheet> list;
};

// Fills `sheets` with the triangles of F that lie within `distance` of the region's open border and face the way that
// it does at its nearest vertex, within 60 degrees. Vertices on each other count as one.
void find_neighbor_sheets(const Positions& region, const OpenBorder& border, const Positions& V, const Triangles& F,
                          double distance, NeighborSheets& sheets);

}  // namespace reflines
