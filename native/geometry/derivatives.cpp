#include "native/geometry/derivatives.h"

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
  for (int t = 0; t < stencils.triangle_count(); ++t) {
    const int first = stencils.offset[t];
    const double* weight = stencils.gradient.data() + 6 * static_cast<size_t>(t);
    const double a = z(stencils.vertex[first]), b = z(stencils.vertex[first + 1]), c = z(stencils.vertex[first + 2]);
    double xx = 0, xy = 0, yy = 0;
    for (int e = first; e < stencils.offset[t + 1]; ++e) {
      const double height = z(stencils.vertex[e]);
      const double* second = stencils.hessian.data() + 3 * static_cast<size_t>(e);
      xx += second[0] * height;
      xy += second[1] * height;
      yy += second[2] * height;
    }
    u.row(t) << weight[0] * a + weight[2] * b + weight[4] * c, weight[1] * a + weight[3] * b + weight[5] * c, xx, xy,
        yy;
  }
}

// Two passes, both of which read the large arrays in order: fetching an entry's eleven weights from the vertex's side
// took five times as long, for they lie far apart.
void apply_transposed(const Stencils& stencils, const StencilEntries& entries, const TriangleDerivatives& y,
                      Vector& products, Vector& result) {
  products.resize(static_cast<Eigen::Index>(stencils.vertex.size()));
#pragma omp parallel for schedule(static) if (stencils.triangle_count() > kWorthThreads)
  for (int t = 0; t < stencils.triangle_count(); ++t) {
    const int first = stencils.offset[t];
    const double* gradient = stencils.gradient.data() + 6 * static_cast<size_t>(t);
    const double* own = y.data() + 5 * static_cast<size_t>(t);
    for (int e = first; e < stencils.offset[t + 1]; ++e) {
      const double* second = stencils.hessian.data() + 3 * static_cast<size_t>(e);
      products(e) = second[0] * own[2] + second[1] * own[3] + second[2] * own[4];
    }
    for (int i = 0; i < 3; ++i) products(first + i) += gradient[2 * i] * own[0] + gradient[2 * i + 1] * own[1];
  }
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
