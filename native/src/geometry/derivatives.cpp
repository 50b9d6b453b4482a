#include "geometry/derivatives.h"

#include <algorithm>

namespace reflines {

StencilEntries::StencilEntries(const Stencils& stencils, int vertex_count)
    : entries_of_vertex(make_incidence(vertex_count,
                                       [&](const auto& take) {
                                         for (int e = 0; e < static_cast<int>(stencils.vertex.size()); ++e)
                                           take(stencils.vertex[e], e);
                                       })),
      triangle(stencils.vertex.size()) {
  for (int t = 0; t < stencils.triangle_count(); ++t)
    std::fill(triangle.begin() + stencils.offset[t], triangle.begin() + stencils.offset[t + 1], t);
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
