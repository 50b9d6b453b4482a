#include "reflection/hessian_assembly.h"

#include <omp.h>

#include <algorithm>

#include "base/parallel_failure.h"

namespace reflines {
namespace {

constexpr int kChunkSize = 4096;

// Returns M w for the packed upper triangle m of M (see Energy::ElementHessians) and an entry's column w of D: (p, q)
// is its gradient weight, 0 except at the triangle's own corners.
Vector5 multiply_packed(const double* m, double p, double q, const double* w) {
  Vector5 result;
  result << m[0] * p + m[1] * q + m[2] * w[0] + m[3] * w[1] + m[4] * w[2],
      m[1] * p + m[5] * q + m[6] * w[0] + m[7] * w[1] + m[8] * w[2],
      m[2] * p + m[6] * q + m[9] * w[0] + m[10] * w[1] + m[11] * w[2],
      m[3] * p + m[7] * q + m[10] * w[0] + m[12] * w[1] + m[13] * w[2],
      m[4] * p + m[8] * q + m[11] * w[0] + m[13] * w[1] + m[14] * w[2];
  return result;
}

Incidence list_vertices_of_unknowns(const std::vector<int>& column, int unknown_count) {
  return make_incidence(unknown_count, [&](const auto& take) {
    for (int v = 0; v < static_cast<int>(column.size()); ++v) {
      if (column[v] >= 0) take(column[v], v);
    }
  });
}

}  // namespace

HessianAssembly::HessianAssembly(const Stencils& stencils, const StencilEntries& entries, std::vector<int> column,
                                 int unknown_count)
    : stencils_(stencils),
      entries_(entries),
      column_(std::move(column)),
      vertices_(list_vertices_of_unknowns(column_, unknown_count)),
      H_(unknown_count, unknown_count) {
  int* outer = H_.outerIndexPtr();
  std::vector<std::vector<int>> rows((unknown_count + kChunkSize - 1) /
                                     kChunkSize);  // of some neighbouring columns each
  const auto find_rows = [&](int c, std::vector<int>& last) {
    for (int i = c * kChunkSize; i < std::min((c + 1) * kChunkSize, unknown_count); ++i) {
      const size_t before = rows[c].size();
      append_rows(i, last, rows[c]);
      outer[i + 1] = static_cast<int>(rows[c].size() - before);
    }
  };
  position_.resize(omp_get_max_threads());
  ParallelFailure failure;
#pragma omp parallel if (unknown_count > kWorthThreads)
  {
    std::vector<int>& last = position_[omp_get_thread_num()];
    failure.run([&] { last.assign(unknown_count, -1); });
#pragma omp for schedule(dynamic)
    for (int c = 0; c < static_cast<int>(rows.size()); ++c) failure.run([&] { find_rows(c, last); });
  }
  failure.rethrow();
  for (int i = 0; i < unknown_count; ++i) outer[i + 1] += outer[i];
  H_.resizeNonZeros(outer[unknown_count]);
  int* inner = H_.innerIndexPtr();
  for (const std::vector<int>& some : rows) inner = std::copy(some.begin(), some.end(), inner);
}

// Appends the unknowns from `unknown` on that occur with it in a stencil, ascending; `last` marks rows already found.
// (A search among the rows would take the square of their number, which at the pole of a fan is the number of spokes.)
void HessianAssembly::append_rows(int unknown, std::vector<int>& last, std::vector<int>& rows) const {
  const auto before = static_cast<std::ptrdiff_t>(rows.size());
  const Incidence& lists = entries_.entries_of_vertex;
  last[unknown] = unknown;
  rows.push_back(unknown);  // a vertex that no stencil contains has a diagonal entry, too
  for (int i = vertices_.begin(unknown); i < vertices_.end(unknown); ++i) {
    const int v = vertices_.items[i];
    for (int k = lists.begin(v); k < lists.end(v); ++k) {
      const int t = entries_.triangle[lists.items[k]];
      for (int e = stencils_.offset[t]; e < stencils_.offset[t + 1]; ++e) {
        const int row = column_[stencils_.vertex[e]];
        if (row < unknown || last[row] == unknown) continue;
        last[row] = unknown;
        rows.push_back(row);
      }
    }
  }
  std::sort(rows.begin() + before, rows.end());
}

void HessianAssembly::fill_column(int unknown, const Energy::ElementHessians& elements, std::vector<int>& position) {
  double* values = H_.valuePtr();
  for (int k = H_.outerIndexPtr()[unknown]; k < H_.outerIndexPtr()[unknown + 1]; ++k) {
    position[H_.innerIndexPtr()[k]] = k;
    values[k] = 0;
  }
  for (int i = vertices_.begin(unknown); i < vertices_.end(unknown); ++i) {
    add_vertex(vertices_.items[i], unknown, elements, position);
  }
}

void HessianAssembly::add_vertex(int v, int unknown, const Energy::ElementHessians& elements,
                                 const std::vector<int>& position) {
  double* values = H_.valuePtr();
  const Incidence& lists = entries_.entries_of_vertex;
  for (int k = lists.begin(v); k < lists.end(v); ++k) {
    const int own = lists.items[k], t = entries_.triangle[own], first = stencils_.offset[t], slot = own - first;
    const double* gradient = stencils_.gradient.data() + 6 * static_cast<size_t>(t);
    const double* second = stencils_.hessian.data() + 3 * static_cast<size_t>(first);
    const bool corner = slot < 3;
    const Vector5 m = multiply_packed(elements.data() + 15 * static_cast<size_t>(t), corner ? gradient[2 * slot] : 0.0,
                                      corner ? gradient[2 * slot + 1] : 0.0, second + 3 * slot);
    for (int j = 0; j < stencils_.offset[t + 1] - first; ++j) {
      const int row = column_[stencils_.vertex[first + j]];
      if (row < unknown) continue;
      double value = m(2) * second[3 * j] + m(3) * second[3 * j + 1] + m(4) * second[3 * j + 2];
      if (j < 3) value += m(0) * gradient[2 * j] + m(1) * gradient[2 * j + 1];
      values[position[row]] += value;
    }
  }
}

const SparseMatrix& HessianAssembly::assemble(const Energy::ElementHessians& elements, const Vector& diagonal) {
  const int n = vertices_.size();
  position_.resize(omp_get_max_threads());
  ParallelFailure failure;
#pragma omp parallel if (n > kWorthThreads)
  {
    std::vector<int>& position = position_[omp_get_thread_num()];
    failure.run([&] { position.resize(n); });
#pragma omp for schedule(static)
    for (int i = 0; i < n; ++i) failure.run([&] { fill_column(i, elements, position); });
  }
  failure.rethrow();
  for (int v = 0; v < diagonal.size(); ++v) {
    if (column_[v] >= 0) H_.valuePtr()[H_.outerIndexPtr()[column_[v]]] += diagonal(v);
  }
  return H_;
}

}  // namespace reflines
