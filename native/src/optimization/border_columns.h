// The sparse columns by which a factored matrix is bordered.
#pragma once

#include <utility>
#include <vector>

#include "optimization/linear/linear_solver.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

// Columns B (n x m) beside a factored matrix A, and their products B^T A^-1 B, from which the Schur complement of a
// bordered system is made. Each column has the number of an unknown or a function. Where the solver has halves, A^-1 =
// (L^-1 P)^T L^-1 P, and the products need no solve; else they take one for each column.
class BorderColumns {
 public:
  explicit BorderColumns(LinearSolver& solver) : solver_(solver), has_halves_(solver.has_halves()) {}

  void clear();
  void use_halves(bool may);  // clears where that changes how columns are kept
  int count() const { return static_cast<int>(unknowns_.size()); }
  int find(int unknown) const;  // the unknown's column, or -1

  int solves() const { return solves_; }  // made until now

  // Returns the unknowns in an order in which their columns are cheap to add.
  std::vector<int> sort(std::vector<int> unknowns) const { return solver_.sort_by_elimination(std::move(unknowns)); }

  // Adds columns (n x #unknowns). Throws Cancelled, with some of them added.
  void add(const std::vector<int>& unknowns, const SparseMatrix& columns, const Progress* progress);

  const Eigen::MatrixXd& products() const { return products_; }  // B^T A^-1 B, m x m

  // Solves A x = right - B z in two steps: `begin` returns B^T A^-1 right (m), from which a caller finds z, and
  // `finish` returns x.
  Vector begin(const Vector& right);
  Vector finish(const Vector& z);
  Vector respond(const Vector& z);  // A^-1 B z

 private:
  void add_some(const SparseMatrix& columns);
  Vector finish_from(Vector x, const Vector& z);

  LinearSolver& solver_;
  bool has_halves_;
  int solves_ = 0;
  std::vector<int> unknowns_;
  std::vector<SparseColumns> columns_;  // L^-1 P B where the solver has halves, else B
  Eigen::MatrixXd products_;
  Vector right_, solved_;  // the last right-hand side, and L^-1 P or A^-1 times it
};

}  // namespace reflines
