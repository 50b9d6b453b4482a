#include "geometry/derivatives.h"

namespace reflines {

StencilEntries::StencilEntries(const Stencils& stencils, int vertex_count) {
  Incidence& lists = entries_of_vertex;
  lists.offset.assign(vertex_count + 1, 0);
  for (int v : stencils.vertex) ++lists.offset[v + 1];
  for (int v = 0; v < vertex_count; ++v) lists.offset[v + 1] += lists.offset[v];
  lists.items.resize(stencils.vertex.size());
  triangle.resize(stencils.vertex.size());
  std::vector<int> next(lists.offset.begin(), lists.offset.end() - 1);
  for (int t = 0; t < stencils.triangle_count(); ++t) {
    for (int e = stencils.offset[t]; e < stencils.offset[t + 1]; ++e) {
      lists.items[next[stencils.vertex[e]]++] = e;
      triangle[e] = t;
    }
  }
}

void apply_stencils(const Stencils& stencils, const Vector& z, TriangleDerivatives& u) {
  u.resize(stencils.triangle_count(), 5);
#pragma omp parallel for schedule(static) if (stencils.triangle_count() > kWorthThreads)
  for (int t = 0; t < stencils.triangle_count(); ++t) u.row(t) = apply_stencil(stencils, t, z);
}

void sum_products(const StencilEntries& entries, const Vector& products, Vector& result) {
  const Incidence& lists = entries.entries_of_vertex;
  result.resize(lists.size());
#pragma omp parallel for schedule(static) if (lists.size() > kWorthThreads)
  for (int v = 0; v < lists.size(); ++v) {
    double sum = 0;
    for (int k = lists.begin(v); k < lists.end(v); ++k) sum += products(lists.items[k]);
    result(v) = sum;
  }
}

}  // namespace reflines
