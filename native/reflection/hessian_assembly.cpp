#include "native/reflection/hessian_assembly.h"

#include <algorithm>

namespace reflines {
namespace {

Matrix5 unpacked(const Energy::ElementHessians& elements, int t) {
  Matrix5 M;
  int k = 0;
  for (int i = 0; i < 5; ++i) {
    for (int j = i; j < 5; ++j) M(i, j) = M(j, i) = elements(t, k++);
  }
  return M;
}

}  // namespace

HessianAssembly::HessianAssembly(const Stencils& stencils, const StencilEntries& entries, std::vector<int> column,
                                 int unknown_count)
    : stencils_(stencils),
      entries_(entries),
      column_(std::move(column)),
      vertex_(unknown_count),
      H_(unknown_count, unknown_count) {
  for (size_t v = 0; v < column_.size(); ++v) {
    if (column_[v] >= 0) vertex_[column_[v]] = static_cast<int>(v);
  }
  std::vector<std::vector<int>> rows(unknown_count);
  const Incidence& lists = entries.entries_of_vertex;
#pragma omp parallel for schedule(static)
  for (int i = 0; i < unknown_count; ++i) {
    std::vector<int>& row = rows[i];
    for (int k = lists.begin(vertex_[i]); k < lists.end(vertex_[i]); ++k) {
      const int t = entries.triangle[lists.items[k]];
      for (int e = stencils.offset[t]; e < stencils.offset[t + 1]; ++e) {
        if (column_[stencils.vertex[e]] >= i) row.push_back(column_[stencils.vertex[e]]);
      }
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    row.shrink_to_fit();
  }
  int* outer = H_.outerIndexPtr();
  for (int i = 0; i < unknown_count; ++i) outer[i + 1] = outer[i] + static_cast<int>(rows[i].size());
  H_.resizeNonZeros(outer[unknown_count]);
  for (int i = 0; i < unknown_count; ++i) std::copy(rows[i].begin(), rows[i].end(), H_.innerIndexPtr() + outer[i]);
}

void HessianAssembly::fill_column(int unknown, const Energy::ElementHessians& elements, std::vector<int>& position) {
  double* values = H_.valuePtr();
  for (int k = H_.outerIndexPtr()[unknown]; k < H_.outerIndexPtr()[unknown + 1]; ++k) {
    position[H_.innerIndexPtr()[k]] = k;
    values[k] = 0;
  }
  const Incidence& lists = entries_.entries_of_vertex;
  const int v = vertex_[unknown];
  for (int k = lists.begin(v); k < lists.end(v); ++k) {
    const int t = entries_.triangle[lists.items[k]];
    const Vector5 m = unpacked(elements, t) * entry_weights(stencils_, t, lists.items[k]);
    for (int e = stencils_.offset[t]; e < stencils_.offset[t + 1]; ++e) {
      const int row = column_[stencils_.vertex[e]];
      if (row >= unknown) values[position[row]] += m.dot(entry_weights(stencils_, t, e));
    }
  }
}

const SparseMatrix& HessianAssembly::assemble(const Energy::ElementHessians& elements, const Vector& diagonal) {
  const int n = static_cast<int>(vertex_.size());
#pragma omp parallel
  {
    std::vector<int> position(n);
#pragma omp for schedule(static)
    for (int i = 0; i < n; ++i) fill_column(i, elements, position);
  }
  for (int i = 0; i < n && diagonal.size() > 0; ++i) H_.valuePtr()[H_.outerIndexPtr()[i]] += diagonal(vertex_[i]);
  return H_;
}

}  // namespace reflines
