#include "restoration/used_vertices.h"

namespace reflines {

UsedVertices find_used_vertices(const Triangles& F, int vertex_count) {
  IndexVector number = IndexVector::Constant(vertex_count, -1);
  for (const int v : F.reshaped()) number(v) = 0;
  UsedVertices used;
  for (int v = 0; v < vertex_count; ++v) {
    if (number(v) < 0) continue;
    number(v) = static_cast<int>(used.index.size());
    used.index.push_back(v);
  }
  used.F = F.unaryExpr([&number](int v) { return number(v); });
  return used;
}

}  // namespace reflines
