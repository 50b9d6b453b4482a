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
#pragma omp parallel for schedule(static)
  for (int t = 0; t < stencils.triangle_count(); ++t) {
    const int first = stencils.offset[t];
    const double* weight = stencils.gradient.data() + 6 * t;
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

Eigen::Matrix<double, 5, 1> entry_weights(const Stencils& stencils, int triangle, int entry) {
  const int slot = entry - stencils.offset[triangle];
  Eigen::Matrix<double, 5, 1> weights;
  weights << (slot < 3 ? stencils.gradient(triangle, 2 * slot) : 0.0),
      (slot < 3 ? stencils.gradient(triangle, 2 * slot + 1) : 0.0), stencils.hessian(entry, 0),
      stencils.hessian(entry, 1), stencils.hessian(entry, 2);
  return weights;
}

void apply_transposed(const Stencils& stencils, const StencilEntries& entries, const TriangleDerivatives& y,
                      Vector& result) {
  const Incidence& lists = entries.entries_of_vertex;
  result.resize(lists.size());
#pragma omp parallel for schedule(static)
  for (int v = 0; v < lists.size(); ++v) {
    double sum = 0;
    for (int k = lists.begin(v); k < lists.end(v); ++k) {
      const int e = lists.items[k], t = entries.triangle[e];
      sum += entry_weights(stencils, t, e).dot(y.row(t));
    }
    result(v) = sum;
  }
}

}  // namespace reflines
