#include "geometry/crease.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "base/parallel_failure.h"
#include "base/union_find.h"
#include "geometry/bend_contrast.h"
#include "geometry/mesh.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr double kChainFraction = 0.25;  // bend of the edges of a chain, relative to the crease angle
constexpr double kChainLength = 0.08;    // shortest chain and widest strip, relative to the region's extent
// The least contrast (see bend_contrast) of a crease: of 240 coarse round shapes none exceeds 1.9 but the tips of
// cones.
constexpr double kJump = 2.0;

// Returns for every vertex the extent of the chain of marked edges that it belongs to: twice the largest distance from
// its centre. The diagonal of a box would depend on the object's rotation.
Vector chain_extent(const Positions& V, const Triangles& F, const EdgeMask& marked) {
  UnionFind chains(V.rows());
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (marked(t, i)) chains.unite(F(t, (i + 1) % 3), F(t, (i + 2) % 3));
    }
  }
  Positions centre = Positions::Zero(V.rows(), 3);
  Vector count = Vector::Zero(V.rows()), radius = Vector::Zero(V.rows());
  for (int v = 0; v < V.rows(); ++v) {
    centre.row(chains.find(v)) += V.row(v);
    count(chains.find(v)) += 1;
  }
  for (int v = 0; v < V.rows(); ++v) {
    const int r = chains.find(v);
    radius(r) = std::max(radius(r), (V.row(v) - centre.row(r) / count(r)).norm());
  }
  Vector extent(V.rows());
  for (int v = 0; v < V.rows(); ++v) extent(v) = 2 * radius(chains.find(v));
  return extent;
}

double region_extent(const Positions& V, const Triangles& F) {
  Vector3 centre = Vector3::Zero();
  for (int k = 0; k < F.size(); ++k) centre += V.row(F.data()[k]).transpose() / static_cast<double>(F.size());
  double radius = 0;
  for (int k = 0; k < F.size(); ++k) radius = std::max(radius, (V.row(F.data()[k]).transpose() - centre).norm());
  return 2 * radius;
}

// Marks edges that bend by more than `least` and have the contrast of a crease; those that bend by more than `sharp`
// also where the surface ends too soon to decide. Each edge is tested once, from its first triangle: from the other one
// the sums round differently.
EdgeMask find_contrasting_edges(const BentSurface& surface, double least, double sharp, double widest) {
  EdgeMask result = EdgeMask::Constant(surface.F.rows(), 3, false);
  run_parallel(static_cast<int>(surface.F.rows()), 1024, [&](int t) {
    for (int i = 0; i < 3; ++i) {
      if (surface.neighbors(t, i) < t || !(surface.bend(t, i) > least)) continue;
      const double contrast = bend_contrast(surface, t, i, widest);
      result(t, i) = contrast < 0 ? surface.bend(t, i) > sharp : contrast > kJump;
    }
  });
  for (int t = 0; t < surface.F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (result(t, i)) result(surface.neighbors(t, i), find_facing_corner(surface.F, surface.neighbors, t, i)) = true;
    }
  }
  return result;
}

EdgeMask find_bent_edges(const Positions& V, const Triangles& F, const Triangles& neighbors, double angle) {
  const double length = kChainLength * region_extent(V, F);
  const Positions normals = triangle_normals(V, F);
  const BentSurface surface{V, F, neighbors, normals, edge_bends(normals, neighbors)};
  EdgeMask result = find_contrasting_edges(surface, kChainFraction * angle, angle, length);
  if (!result.any()) return result;
  const Vector extent = chain_extent(V, F, result);
  for (int t = 0; t < F.rows(); ++t) {
    for (int i = 0; i < 3; ++i) {
      result(t, i) = result(t, i) && (surface.bend(t, i) > angle || extent(F(t, (i + 1) % 3)) > length);
    }
  }
  return result;
}

}  // namespace

Positions triangle_normals(const Positions& V, const Triangles& F) {
  Positions normals(F.rows(), 3);
#pragma omp parallel for schedule(static) if (F.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(F.rows()); ++t) normals.row(t) = unit_normal(V, F, t);
  return normals;
}

EdgeBends edge_bends(const Positions& normals, const Triangles& neighbors) {
  EdgeBends result(neighbors.rows(), 3);
#pragma omp parallel for schedule(static) if (neighbors.rows() > kWorthThreads)
  for (int t = 0; t < static_cast<int>(neighbors.rows()); ++t) {
    const Vector3 own = normals.row(t);
    for (int i = 0; i < 3; ++i) {
      const Vector3 other = normals.row(neighbors(t, i) < 0 ? t : neighbors(t, i));
      result(t, i) = std::atan2(own.cross(other).norm(), own.dot(other));
    }
  }
  return result;
}

EdgeMask marked_edges(const Triangles& F, const CreaseOptions& options) {
  std::set<std::pair<int, int>> marked;
  for (int e = 0; e < options.marked.rows(); ++e) {
    marked.insert(std::minmax(options.marked(e, 0), options.marked(e, 1)));
  }
  EdgeMask result = EdgeMask::Constant(F.rows(), 3, false);
  for (int t = 0; t < F.rows() && !marked.empty(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int a = F(t, (i + 1) % 3), b = F(t, (i + 2) % 3);
      result(t, i) = marked.contains(std::minmax(a, b));
    }
  }
  return result;
}

EdgeMask crease_edges(const Positions& V, const Triangles& F, const Triangles& neighbors,
                      const CreaseOptions& options) {
  if (!(options.angle >= 0)) throw InvalidInput("The crease angle must be 0 or a positive number, in radians.");
  if (options.rule == CreaseRule::kNone) return EdgeMask::Constant(F.rows(), 3, false);
  const EdgeMask marked = marked_edges(F, options) && neighbors.array() >= 0;
  return options.rule == CreaseRule::kMarked ? marked : marked || find_bent_edges(V, F, neighbors, options.angle);
}

}  // namespace reflines
