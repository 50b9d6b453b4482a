// A factor of the rows and columns of a matrix that belong to unknowns which are not held.
#pragma once

#include <Eigen/Cholesky>
#include <optional>
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
//   H_FF x_F + H_FR x_R + E_C y = b_F,   H_RF x_F + H_RR x_R = b_R,   E_C^T x_F = x_C.
class HeldFactor {
 public:
  // The number of new columns above which another factorization is made.
  static constexpr int kMostNewColumns = 128;

  explicit HeldFactor(LinearSolver& solver) : solver_(solver), border_(solver) {}

  // Factors H (lower triangle, analysed by the solver before). Throws Cancelled.
  void factorize(const SparseMatrix& H, const Sides& held, const Progress* progress);

  // Tells that the matrix, or the solver's factor, has become another than H.
  void forget();
  bool is_current() const { return is_current_; }  // the solver's factor is that of the matrix given last

  // Holds these unknowns and no others, of the matrix H that was factored. Returns the number of solves that took: none
  // where the solver has halves, else one for each new column. Returns nothing where another factorization is cheaper,
  // or there is none of H. Throws Cancelled.
  std::optional<int> hold(const SparseMatrix& H, const Sides& held, const Progress* progress);

  // Returns true where the factor leaves out all that is held, and nothing else.
  bool leaves_out(const Sides& held) const;

  Vector select_left_out(const Vector& x) const;  // x (n) for the unknowns that the factor leaves out, else 0

  // Solves for x. Held unknowns become 0, and contacts their entries of `at_contacts` (n, or empty for 0), whatever
  // their right-hand side. Returns the number of solves by the factor.
  int solve(Vector& x, const Vector& at_contacts = {});

  // Returns whether the forces of contacts cost no solve beside the first for a right-hand side.
  bool tells_forces() const { return solver_.has_halves(); }

  // Returns the forces (#contacts) by which these, the held unknowns that the factor does not leave out, balance the
  // right-hand side at their entries of `at_contacts` (n).
  Vector find_forces(const Vector& right, const Vector& at_contacts);
  const std::vector<int>& contacts() const { return differences_.contacts; }

 private:
  // The unknowns whose state differs from that in the factor, ascending.
  struct Differences {
    std::vector<int> contacts, released;
  };
  Differences find_differences(const Sides& held) const;
  SparseMatrix make_columns(const SparseMatrix& H, const std::vector<int>& unknowns) const;
  Eigen::MatrixXd select_block(const SparseMatrix& H, const std::vector<int>& unknowns) const;
  void factorize_schur_complement(const SparseMatrix& H);
  Vector find_border(const Vector& reached, const Vector& of_released, const Vector& at_contacts) const;

  LinearSolver& solver_;
  Sides factored_;  // n: held by the factor
  bool is_current_ = false;
  BorderColumns border_;  // of unknowns that were contacts or released since the factorization
  Differences differences_;
  std::vector<int> contact_column_, released_column_;  // their places in the border
  Eigen::LLT<Eigen::MatrixXd> of_contacts_;            // of E_C^T H_FF^-1 E_C
  Eigen::MatrixXd coupling_;                           // E_C^T H_FF^-1 H_FR
  Eigen::LLT<Eigen::MatrixXd> of_released_;            // of the Schur complement that is left
};

}  // namespace reflines
