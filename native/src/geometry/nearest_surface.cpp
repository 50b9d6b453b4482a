#include "geometry/nearest_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/mesh.h"

namespace reflines {
namespace {

constexpr int kLeaf = 8;  // triangles

Vector3 nearest_in_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double length = (b - a).squaredNorm();
  return length > 0 ? Vector3(a + std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) * (b - a)) : a;
}

}  // namespace

Vector3 nearest_in_triangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 n = (b - a).cross(c - a);
  const auto inside = [&](const Vector3& from, const Vector3& to) { return n.dot((to - from).cross(p - from)) >= 0; };
  if (n.squaredNorm() > 0 && inside(a, b) && inside(b, c) && inside(c, a))
    return p - n * (n.dot(p - a) / n.squaredNorm());
  Vector3 best = nearest_in_segment(p, a, b);
  for (const auto& [from, to] : {std::pair(b, c), std::pair(c, a)}) {
    const Vector3 other = nearest_in_segment(p, from, to);
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  }
  return best;
}

NearestSurface::NearestSurface(const Positions& V, const Triangles& F, std::vector<int> chosen)
    : V_(V), F_(F), order_(std::move(chosen)) {
  if (!order_.empty()) build(0, static_cast<int>(order_.size()));
}

NearestSurface::NearestSurface(const Positions& V, const Triangles& F)
    : NearestSurface(V, F, list_marked(Mask::Constant(F.rows(), true))) {}

int NearestSurface::build(int begin, int end) {
  const int own = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, begin, end});
  Eigen::AlignedBox3d box;
  for (int k = begin; k < end; ++k) {
    for (int i = 0; i < 3; ++i) box.extend(corner(order_[k], i));
  }
  nodes_[own].box = box;
  if (end - begin <= kLeaf) return own;
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  const auto centre = [&](int t) { return V_(F_(t, 0), axis) + V_(F_(t, 1), axis) + V_(F_(t, 2), axis); };
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int s, int t) { return centre(s) < centre(t); });
  build(begin, middle);
  const int second = build(middle, end);
  nodes_[own].second = second;
  return own;
}

NearestPoint NearestSurface::find(const Vector3& point, double within) const {
  NearestPoint best;
  double squared = within * within;
  std::vector<int> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const int own = open.back();
    const Node& node = nodes_[own];
    open.pop_back();
    if (node.box.squaredExteriorDistance(point) > squared) continue;
    if (node.second >= 0) {
      const bool second_first =
          nodes_[node.second].box.squaredExteriorDistance(point) < nodes_[own + 1].box.squaredExteriorDistance(point);
      open.push_back(second_first ? own + 1 : node.second);
      open.push_back(second_first ? node.second : own + 1);
      continue;
    }
    best.compared += node.end - node.begin;
    for (int k = node.begin; k < node.end; ++k) {
      const Vector3 near = nearest_in_triangle(point, corner(order_[k], 0), corner(order_[k], 1), corner(order_[k], 2));
      if ((near - point).squaredNorm() > squared) continue;
      squared = (near - point).squaredNorm();
      best = {order_[k], near, std::sqrt(squared), best.compared};
    }
  }
  return best;
}

}  // namespace reflines
