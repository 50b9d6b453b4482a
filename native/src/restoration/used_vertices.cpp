#include "restoration/used_vertices.h"

namespace reflines {

UsedVertices find_used_vertices(const Triangles& F, int vertex_count) {
  UsedVertices used{{}, {}, IndexVector::Constant(vertex_count, -1)};
  IndexVector& number = used.number;
  for (const int v : F.reshaped()) number(v) = 0;
  for (int v = 0; v < vertex_count; ++v) {
    if (number(v) < 0) continue;
    number(v) = static_cast<int>(used.index.size());
    used.index.push_back(v);
  }
  used.F = F.unaryExpr([&number](int v) { return number(v); });
  return used;
}

IndexVector renumber_partners(const IndexVector& partner, const UsedVertices& used) {
  return partner(used.index).unaryExpr([&used](int v) { return v < 0 ? -1 : used.number(v); });
}

Surroundings renumber_surroundings(const Surroundings& around, const UsedVertices& used, int vertex_count) {
  const int kept = static_cast<int>(used.index.size());
  Surroundings result{around.V, Triangles(around.F.rows(), 3)};
  int count = 0;
  for (const auto& triangle : around.F.rowwise()) {
    const Eigen::RowVector3i renumbered =
        triangle.unaryExpr([&](int v) { return v < vertex_count ? used.number(v) : v - vertex_count + kept; });
    if (renumbered.minCoeff() >= 0) result.F.row(count++) = renumbered;
  }
  result.F.conservativeResize(count, 3);
  return result;
}

}  // namespace reflines
