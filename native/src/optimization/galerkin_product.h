// The Galerkin product P^T H P of a sparse Hessian and a prolongation P, with a pattern that is computed once.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

class GalerkinProduct {
 public:
  // `modes` is P^T, m x n: column j says by how much each motion moves unknown j. It outlives the product.
  explicit GalerkinProduct(const SparseMatrix& modes);

  // P^T H P, lower triangle, m x m, of the lower triangle H, n x n, whose pattern is the same in every call. The
  // reference stays valid and is overwritten by the next call.
  const SparseMatrix& project(const SparseMatrix& hessian);

 private:
  // Unknowns that begin with the same mode; they touch nearly the same modes, so that their share of P^T H P is one
  // small dense block: `rows` are the modes of the group itself, `columns` those of its neighbours in H.
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
  std::vector<int> row_place_, column_place_;  // m: where a mode stands in the block at hand
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block_;
  Eigen::RowVectorXd line_;
};

}  // namespace reflines
