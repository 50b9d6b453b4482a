#include "geometry/next_edges.h"

#include <map>

namespace reflines {
namespace {

constexpr double kCorner = 0.77;  // cosine of 40 degrees

}  // namespace

std::vector<int> find_next_edges(const Positions& V, const Edges& edges,
                                 const std::function<bool(int edge, int next)>& belong) {
  std::map<int, int> begins;  // the edge that begins at a vertex
  for (int k = 0; k < edges.rows(); ++k) begins[edges(k, 0)] = k;
  std::vector<int> result(edges.rows(), -1);
  for (int k = 0; k < edges.rows(); ++k) {
    const auto next = begins.find(edges(k, 1));
    if (next == begins.end() || !belong(k, next->second)) continue;
    const Vector3 a = V.row(edges(k, 1)) - V.row(edges(k, 0));
    const Vector3 b = V.row(edges(next->second, 1)) - V.row(edges(next->second, 0));
    if (a.dot(b) >= kCorner * a.norm() * b.norm()) result[k] = next->second;
  }
  return result;
}

}  // namespace reflines
