#include "optimization/linear/multifrontal_cholesky.h"

#include <algorithm>
#include <cstddef>

#include "base/parallel_failure.h"

namespace reflines {

MultifrontalCholesky::MultifrontalCholesky(const SupernodalFactor& factor, const SparseMatrix& pattern,
                                           const int* order)
    : factor_(factor), tree_(factor), children_(factor.supernode_count), updates_(factor.supernode_count) {
  for (int s = 0; s < factor.supernode_count; ++s) {
    if (tree_.parent[s] >= 0) children_[tree_.parent[s]].push_back(s);
  }
  find_targets(pattern, order);
}

// Returns the row of a supernode's block that is row i of the factor.
int MultifrontalCholesky::find_row(int s, int i) const {
  if (i < factor_.first_column[s + 1]) return i - factor_.first_column[s];
  const int *begin = factor_.rows_below(s), *end = begin + factor_.below(s);
  return factor_.columns(s) + static_cast<int>(std::lower_bound(begin, end, i) - begin);
}

void MultifrontalCholesky::find_targets(const SparseMatrix& pattern, const int* order) {
  std::vector<int> place(factor_.size);
  for (int j = 0; j < factor_.size; ++j) place[order[j]] = j;
  target_.resize(pattern.nonZeros());
#pragma omp parallel for schedule(static)
  for (int first = 0; first < factor_.size; ++first) {  // neighbours in this order have common rows of the factor
    const int column = order[first];
    for (int k = pattern.outerIndexPtr()[column]; k < pattern.outerIndexPtr()[column + 1]; ++k) {
      const auto [j, i] = std::minmax(first, place[pattern.innerIndexPtr()[k]]);
      const int s = tree_.supernode[j];
      target_[k] = factor_.block_start[s] + (j - factor_.first_column[s]) * factor_.height(s) + find_row(s, i);
    }
  }
}

// Fills the factor with the entries of the matrix.
void MultifrontalCholesky::copy_values(const double* values) {
#pragma omp parallel if (!tree_.above.empty())
  {
#pragma omp for schedule(static)
    for (int s = 0; s < factor_.supernode_count; ++s)
      std::fill_n(factor_.block(s), static_cast<std::size_t>(factor_.height(s)) * factor_.columns(s), 0.0);
#pragma omp for schedule(static)
    for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(target_.size()); ++k)
      factor_.value[target_[k]] = values[k];
  }
}

bool MultifrontalCholesky::factorize(const double* values, double* factor) {
  factor_.value = factor;
  copy_values(values);
  bool definite = true;
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic) reduction(&& : definite) if (!tree_.above.empty())
  for (int t = 0; t < static_cast<int>(tree_.subtrees.size()); ++t)
    failure.run([&] { definite = factorize_subtree(tree_.subtrees[t]) && definite; });
  failure.rethrow();
  for (const int s : tree_.above) definite = definite && factorize_supernode(s, true);
  return definite;
}

bool MultifrontalCholesky::factorize_subtree(const EliminationSubtrees::Range& subtree) {
  for (int s = subtree.begin; s < subtree.end; ++s) {
    if (!factorize_supernode(s, false)) return false;
  }
  return true;
}

bool MultifrontalCholesky::factorize_supernode(int s, bool split) {
  const auto below = static_cast<std::size_t>(factor_.below(s));
  updates_[s] = std::make_unique<double[]>(below * below);
  const DenseFront front{factor_.columns(s), factor_.below(s), factor_.block(s), updates_[s].get()};
  for (const int child : children_[s]) {
    add_update(child, front, factor_.row + factor_.row_start[s], split);
    updates_[child].reset();
  }
  return factorize_front(front, split);
}

// Adds the update matrix of a child, whose rows are some of the front's `rows`.
void MultifrontalCholesky::add_update(int child, const DenseFront& front, const int* rows, bool split) const {
  const int count = factor_.below(child), *child_rows = factor_.rows_below(child);
  std::vector<int> place(count);
  for (int i = 0, k = 0; i < count; ++i) {
    while (rows[k] != child_rows[i]) ++k;
    place[i] = k;
  }
  const double* update = updates_[child].get();
  const auto add_column = [&](int j) {
    const double* from = update + static_cast<std::size_t>(j) * count;
    const int column = place[j] - front.columns;  // of the update matrix
    double* to = column < 0 ? front.at(0, place[j])
                            : front.update + static_cast<std::ptrdiff_t>(column) * front.below - front.columns;
    for (int i = j; i < count; ++i) to[place[i]] += from[i];
  };
  if (!split) {
    for (int j = 0; j < count; ++j) add_column(j);
    return;
  }
#pragma omp parallel for schedule(dynamic, 16)
  for (int j = 0; j < count; ++j) add_column(j);
}

}  // namespace reflines
