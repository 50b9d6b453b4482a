#include "optimization/linear/triangular_solve.h"

#include <algorithm>

#include "optimization/linear/column_sweep.h"

namespace reflines {

struct TriangularSolve::Supernode {
  int first, columns, below;
  const int* row;  // #below
  FactorBlock block;
};

TriangularSolve::TriangularSolve(const SupernodalFactor& factor, const EliminationSubtrees& tree)
    : factor_(factor), tree_(tree), place_above_(factor.size, -1), work_(tree_.subtrees.size()) {
  int above = 0, below = 0, height = 0;
  for (const int s : tree_.above) {
    for (int j = factor.first_column[s]; j < factor.first_column[s + 1]; ++j) place_above_[j] = above++;
  }
  for (int s = 0; s < factor.supernode_count; ++s) {
    below = std::max(below, factor.below(s));
    height = std::max(height, factor.height(s));
  }
  for (Workspace& work : work_) work = {Vector(above), Vector(below), Vector(height)};
  below_.resize(below);
  column_.resize(height);
}

TriangularSolve::Supernode TriangularSolve::supernode(int s) const {
  const int columns = factor_.columns(s), below = factor_.below(s);
  return {factor_.first_column[s], columns, below, factor_.rows_below(s), {columns, below, factor_.block(s)}};
}

void TriangularSolve::solve_lower(const EliminationSubtrees::Range& subtree, Vector& x, Workspace& work) const {
  work.above.setZero();
  const int end = factor_.first_column[subtree.end];
  for (int s = subtree.begin; s < subtree.end; ++s) {
    const Supernode node = supernode(s);
    sweep_forward(node.block, x.data() + node.first, work.below.data(), work.column.data());
    int i = 0;
    for (; i < node.below && node.row[i] < end; ++i) x(node.row[i]) -= work.below(i);
    for (; i < node.below; ++i) work.above(place_above_[node.row[i]]) -= work.below(i);
  }
}

void TriangularSolve::solve_lower_above(Vector& x) {
  for (const int s : tree_.above) {
    const Supernode node = supernode(s);
    auto solved = x.segment(node.first, node.columns);
    for (const Workspace& work : work_) solved += work.above.segment(place_above_[node.first], node.columns);
    sweep_forward(node.block, solved.data(), below_.data(), column_.data());
    for (int i = 0; i < node.below; ++i) x(node.row[i]) -= below_(i);
  }
}

void TriangularSolve::solve_upper(int s, Vector& x, Vector& reached) const {
  const Supernode node = supernode(s);
  for (int i = 0; i < node.below; ++i) reached(i) = x(node.row[i]);
  sweep_backward(node.block, reached.data(), x.data() + node.first);
}

void TriangularSolve::solve_lower(Vector& x) {
#pragma omp parallel for schedule(dynamic) if (!tree_.above.empty())
  for (int t = 0; t < static_cast<int>(work_.size()); ++t) solve_lower(tree_.subtrees[t], x, work_[t]);
  solve_lower_above(x);
}

void TriangularSolve::solve_upper(Vector& x) {
  for (auto s = tree_.above.rbegin(); s != tree_.above.rend(); ++s) solve_upper(*s, x, below_);
#pragma omp parallel for schedule(dynamic) if (!tree_.above.empty())
  for (int t = 0; t < static_cast<int>(work_.size()); ++t) {
    for (int s = tree_.subtrees[t].end - 1; s >= tree_.subtrees[t].begin; --s) solve_upper(s, x, work_[t].below);
  }
}

}  // namespace reflines
