// The Galerkin product P^T H P of a sparse Hessian and a prolongation P, with a pattern that is computed once.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// Computes the product by dense blocks: 62 ms for 103,000 vertices and 1,681 of the cage, where two sparse products by
// Eigen take 200.
class GalerkinProduct {
 public:
  // Takes `modes` = P^T (m x n), which outlives the product: column j holds the moves of unknown j by each mode.
  explicit GalerkinProduct(const SparseMatrix& modes);

  // Returns P^T H P, lower triangle, m x m, of the lower triangle H, n x n, whose pattern is the same in every call.
  // The reference stays valid and is overwritten by the next call.
  const SparseMatrix& project(const SparseMatrix& hessian);

 private:
  // A group of unknowns with the same first mode; they depend on nearly the same modes, so that their contribution to
  // P^T H P is one small dense block: `rows` are the modes of the group itself, `columns` those of its neighbours in H.
  struct Group {
    std::vector<int> unknowns, rows, columns;
  };
  void find_groups();
  void find_modes(const SparseMatrix& hessian, int index);
  void make_pattern();
  void add_block(const Group& group);
  void accumulate(const SparseMatrix& hessian, const Group& group);

  const SparseMatrix& modes_;
  std::vector<Group> groups_;
  SparseMatrix reduced_;
  std::vector<int> row_place_, column_place_;  // m: position of a mode in the current block
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block_;
  Eigen::RowVectorXd line_;
};

}  // namespace reflines
