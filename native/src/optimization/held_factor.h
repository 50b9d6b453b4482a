// A factor of the rows and columns of a matrix that belong to unknowns which are not held.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "optimization/border_columns.h"
#include "optimization/bounds.h"
#include "optimization/linear/linear_solver.h"
#include "reflines/types.h"

namespace reflines {

// The factor of H with the rows and columns of held unknowns cleared except for their diagonal: the pattern, and with
// it the symbolic analysis, stays that of the whole matrix. A few unknowns can be held or released without another
// factorization, by the Schur complement of the system that is bordered by their columns: with C new contacts, whose
// forces are the unknowns y, and R released ones,
//   H_FF x_F + H_FR x_R + E_C y = b_F,   H_RF x_F + H_RR x_R = b_R,   E_C^T x_F = 0.
class HeldFactor {
 public:
  // The number of new columns above which another factorization is made.
  static constexpr int kMostNewColumns = 128;

  explicit HeldFactor(LinearSolver& solver) : solver_(solver), border_(solver) {}

  // Tells whether what is held are unknowns, or functions of many of these, whose columns have dense halves, and are
  // quicker without.
  void hold_functions(bool functions) { border_.use_halves(!functions); }

  // Factors H (lower triangle, analysed by the solver before). Throws Cancelled.
  void factorize(const SparseMatrix& H, const Sides& held, const Progress* progress);

  // Tells that the matrix, or the solver's factor, has become another than H.
  void forget();
  bool is_current() const { return is_current_; }  // the solver's factor is that of the matrix given last

  // Holds these unknowns and no others, of the matrix H that was factored: without a solve where the solver has halves,
  // else by one for each new column. Returns false where another factorization is cheaper, or there is none of H.
  // Throws Cancelled.
  bool hold(const SparseMatrix& H, const Sides& held, const Progress* progress);

  // Returns whether there is a factor of H that leaves out these unknowns and no others.
  bool leaves_out(const Sides& held) const;

  void solve(Vector& x);  // held unknowns become 0, whatever their right-hand side

  // Returns the columns beside the factor, to which the search for contacts adds its own.
  BorderColumns& border() { return border_; }

  // These count the work since this was made.
  int factorizations() const { return factorizations_; }
  int solves() const { return border_.solves(); }

 private:
  // The unknowns whose state differs from that in the factor, ascending.
  struct Differences {
    std::vector<int> contacts, released;
  };
  Differences find_differences(const Sides& held) const;
  SparseMatrix make_columns(const SparseMatrix& H, const std::vector<int>& unknowns) const;
  void factorize_schur_complement(const SparseMatrix& H);

  LinearSolver& solver_;
  Sides factored_;  // n: held by the factor
  bool is_current_ = false;
  int factorizations_ = 0;
  BorderColumns border_;  // of unknowns that were contacts or released since the factorization
  Differences differences_;
  std::vector<int> column_;                     // their places in the border, contacts before released ones
  Eigen::PartialPivLU<Eigen::MatrixXd> schur_;  // of their equations, without the unknowns that the factor has
};

}  // namespace reflines
