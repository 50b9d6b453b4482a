#include "native/geometry/crease_split.h"

#include <algorithm>
#include <numeric>

#include "native/geometry/crease.h"
#include "native/geometry/mesh.h"

namespace reflines {
namespace {

// Corner i of triangle t is 3 t + i. Those of a fan have one representative.
class Fans {
 public:
  explicit Fans(const Triangles& F) : F_(F), parent_(F.size()) { std::iota(parent_.begin(), parent_.end(), 0); }

  void join_across(int t, int edge, int other) {
    for (const int corner : {(edge + 1) % 3, (edge + 2) % 3}) {
      for (int i = 0; i < 3; ++i) {
        if (F_(other, i) == F_(t, corner)) join(3 * t + corner, 3 * other + i);
      }
    }
  }

  int representative(int corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

 private:
  void join(int a, int b) {
    a = representative(a);
    b = representative(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  const Triangles& F_;
  std::vector<int> parent_;
};

Fans fans_between_creases(const Positions& V, const Triangles& F, double angle) {
  const Triangles neighbors = edge_neighbors(F);
  const EdgeBends bend = edge_bends(V, F, neighbors);
  Fans fans(F);
  for (int t = 0; t < static_cast<int>(F.rows()); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) > t && !(bend(t, i) > angle)) fans.join_across(t, i, neighbors(t, i));
    }
  }
  return fans;
}

}  // namespace

SplitSurface split_at_creases(const Positions& V, const Triangles& F, double angle) {
  check_indices(V, F);
  Fans fans = fans_between_creases(V, F, angle);
  SplitSurface split{F, std::vector<int>(V.rows())};
  std::iota(split.vertex.begin(), split.vertex.end(), 0);
  std::vector<bool> taken(V.rows(), false);
  for (int corner = 0; corner < static_cast<int>(F.size()); ++corner) {
    const int first = fans.representative(corner), v = F.data()[corner];
    if (first < corner) {
      split.F.data()[corner] = split.F.data()[first];
    } else if (taken[v]) {
      split.F.data()[corner] = static_cast<int>(split.vertex.size());
      split.vertex.push_back(v);
    }
    taken[v] = true;
  }
  return split;
}

}  // namespace reflines
