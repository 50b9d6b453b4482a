#include "inspection/region_parts.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/mesh.h"

namespace reflines {
namespace {

constexpr size_t kMostParts = 64;

// Numbers the largest parts in the order of their first triangles: #F, -1 elsewhere.
IndexVector number_parts(const Triangles& F, const Mask& region) {
  const std::vector<int> own = list_marked(region);
  const std::vector<std::vector<int>> components = find_components(edge_neighbors(F(own, Eigen::all)));
  std::vector<size_t> sizes;
  for (const std::vector<int>& triangles : components) sizes.push_back(triangles.size());
  std::sort(sizes.rbegin(), sizes.rend());
  const size_t least = sizes.size() > kMostParts ? sizes[kMostParts] + 1 : 0;
  IndexVector part = IndexVector::Constant(F.rows(), -1);
  int number = 0;
  for (const std::vector<int>& triangles : components) {
    if (triangles.size() < least) continue;
    for (const int k : triangles) part(own[k]) = number;
    ++number;
  }
  return part;
}

// Gives numbers to vertices as they are first named.
struct Numbering {
  std::vector<int> number;  // #V, -1: none yet
  int next = 0;

  int name(int v, std::vector<int>& named) {
    if (number[v] < 0) {
      number[v] = next++;
      named.push_back(v);
    }
    return number[v];
  }
};

RegionPart build_part(const Positions& V, const Triangles& F, const IndexVector& part, int k, double near) {
  RegionPart result;
  Numbering numbering{std::vector<int>(V.rows(), -1)};
  result.F.resize((part.array() == k).count(), 3);
  for (Eigen::Index t = 0, count = 0; t < F.rows(); ++t) {
    if (part(t) != k) continue;
    for (int i = 0; i < 3; ++i) result.F(count, i) = numbering.name(F(t, i), result.vertices);
    ++count;
  }
  Eigen::AlignedBox3d box;
  for (const int v : result.vertices) box.extend(V.row(v).transpose());
  const Vector3 margin = Vector3::Constant(near * box.diagonal().norm());
  box = Eigen::AlignedBox3d(box.min() - margin, box.max() + margin);
  const int own = numbering.next;
  std::vector<int> touching;
  for (int t = 0; t < F.rows(); ++t) {
    if (part(t) == k) continue;
    bool touches = false, inside = false;
    for (const int v : F.row(t)) {
      touches = touches || (numbering.number[v] >= 0 && numbering.number[v] < own);
      inside = inside || box.contains(V.row(v).transpose());
    }
    if (touches) touching.push_back(t);
    if (inside) result.beside.push_back(t);
  }
  result.F_around.resize(static_cast<Eigen::Index>(touching.size()), 3);
  for (size_t j = 0; j < touching.size(); ++j) {
    for (int i = 0; i < 3; ++i)
      result.F_around(static_cast<Eigen::Index>(j), i) = numbering.name(F(touching[j], i), result.around_vertices);
  }
  return result;
}

}  // namespace

RegionParts split_region(const Positions& V, const Triangles& F, const Mask& region, double near) {
  RegionParts parts{{}, number_parts(F, region)};
  const int count = parts.part.size() > 0 ? parts.part.maxCoeff() + 1 : 0;
  for (int k = 0; k < count; ++k) parts.list.push_back(build_part(V, F, parts.part, k, near));
  return parts;
}

}  // namespace reflines
