#include "optimization/galerkin_product.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/sort_unique.h"

namespace reflines {
GalerkinProduct::GalerkinProduct(const SparseMatrix& modes) : modes_(modes) { find_groups(); }

void GalerkinProduct::find_groups() {
  std::vector<std::vector<int>> by_first_mode(modes_.rows());
  for (int j = 0; j < modes_.cols(); ++j) {
    const int first = modes_.outerIndexPtr()[j];
    if (first < modes_.outerIndexPtr()[j + 1]) by_first_mode[modes_.innerIndexPtr()[first]].push_back(j);
  }
  for (std::vector<int>& unknowns : by_first_mode) {
    if (!unknowns.empty()) groups_.push_back({std::move(unknowns), {}, {}});
  }
}

const SparseMatrix& GalerkinProduct::project(const SparseMatrix& hessian) {
  if (reduced_.size() == 0) {
    row_place_.assign(modes_.rows(), -1);
    column_place_.assign(modes_.rows(), -1);
    for (std::size_t k = 0; k < groups_.size(); ++k) find_modes(hessian, static_cast<int>(k));
    make_pattern();
  }
  reduced_.coeffs().setZero();
  for (const Group& group : groups_) {
    accumulate(hessian, group);
    add_block(group);
  }
  return reduced_;
}

void GalerkinProduct::find_modes(const SparseMatrix& hessian, int index) {
  Group& group = groups_[index];
  const auto list_once = [this, index](int unknown, std::vector<int>& stamp, std::vector<int>& list) {
    for (SparseMatrix::InnerIterator mode(modes_, unknown); mode; ++mode) {
      if (stamp[mode.index()] != index) list.push_back(static_cast<int>(mode.index()));
      stamp[mode.index()] = index;
    }
  };
  for (const int j : group.unknowns) {
    list_once(j, row_place_, group.rows);
    for (SparseMatrix::InnerIterator entry(hessian, j); entry; ++entry) {
      list_once(static_cast<int>(entry.row()), column_place_, group.columns);
    }
  }
}

void GalerkinProduct::make_pattern() {
  const int m = static_cast<int>(modes_.rows());
  std::vector<std::vector<int>> below(m);
  for (const Group& group : groups_) {
    for (const int a : group.rows) {
      for (const int b : group.columns) below[std::min(a, b)].push_back(std::max(a, b));
    }
  }
  reduced_.resize(m, m);
  for (int a = 0; a < m; ++a) {
    sort_unique(below[a]);
    reduced_.outerIndexPtr()[a + 1] = reduced_.outerIndexPtr()[a] + static_cast<int>(below[a].size());
  }
  reduced_.resizeNonZeros(reduced_.outerIndexPtr()[m]);
  for (int a = 0; a < m; ++a) {
    std::copy(below[a].begin(), below[a].end(), reduced_.innerIndexPtr() + reduced_.outerIndexPtr()[a]);
  }
}

// Adds a group's contribution. With p_j the modes of unknown j, P^T H P = sum_j (p_j w_j^T + w_j p_j^T), w_j = H_jj p_j
// / 2 + sum_{i > j} H_ij p_i: the lower triangle of H is enough, and every entry of it is read once.
void GalerkinProduct::accumulate(const SparseMatrix& hessian, const Group& group) {
  for (int k = 0; k < static_cast<int>(group.rows.size()); ++k) row_place_[group.rows[k]] = k;
  for (int k = 0; k < static_cast<int>(group.columns.size()); ++k) column_place_[group.columns[k]] = k;
  block_.setZero(group.rows.size(), group.columns.size());
  for (const int j : group.unknowns) {
    line_.setZero(group.columns.size());
    for (SparseMatrix::InnerIterator entry(hessian, j); entry; ++entry) {
      const double value = entry.row() == j ? 0.5 * entry.value() : entry.value();
      for (SparseMatrix::InnerIterator mode(modes_, entry.row()); mode; ++mode) {
        line_[column_place_[mode.index()]] += value * mode.value();
      }
    }
    for (SparseMatrix::InnerIterator mode(modes_, j); mode; ++mode) {
      block_.row(row_place_[mode.index()]) += mode.value() * line_;
    }
  }
}

void GalerkinProduct::add_block(const Group& group) {
  for (std::size_t r = 0; r < group.rows.size(); ++r) {
    for (std::size_t c = 0; c < group.columns.size(); ++c) {
      const int a = group.rows[r], b = group.columns[c];
      const int* first = reduced_.innerIndexPtr() + reduced_.outerIndexPtr()[std::min(a, b)];
      const int* last = reduced_.innerIndexPtr() + reduced_.outerIndexPtr()[std::min(a, b) + 1];
      const auto place = std::lower_bound(first, last, std::max(a, b)) - reduced_.innerIndexPtr();
      reduced_.valuePtr()[place] += a == b ? 2.0 * block_(r, c) : block_(r, c);
    }
  }
}

}  // namespace reflines
