// A factor of the rows and columns of a matrix that belong to unknowns which are not held.
#pragma once

#include <Eigen/Cholesky>
#include <optional>
#include <vector>

#include "optimization/bounds.h"
#include "optimization/linear/linear_solver.h"
#include "reflines/types.h"

namespace reflines {

// The factor of H with the rows and columns of held unknowns cleared except for their diagonal: the pattern, and with
// it the symbolic analysis, stays that of the whole matrix. A few more unknowns can be held without another
// factorization, by the Schur complement of their forces.
class HeldFactor {
 public:
  // The number of new contacts above which another factorization is made. It takes as long as 8 to 20 solves, 45 at
  // once, or 100 to 200 by the lower half of the factor along the paths of the contacts; but an unknown that the factor
  // leaves out costs one more factorization once it is released.
  static constexpr int kMostNewContacts = 128;

  explicit HeldFactor(LinearSolver& solver) : solver_(solver) {}

  // Factors H (lower triangle, analysed by the solver before), with `added` (n, or empty) on its diagonal.
  // Throws Cancelled.
  void factorize(const SparseMatrix& H, const Sides& held, const Progress* progress, const Vector& added = {});

  // Tells that the matrix, or the solver's factor, has become another.
  void forget();
  bool is_current() const { return is_current_; }  // the solver's factor is that of the matrix given last

  // Holds these unknowns, of which those that the factor does not leave out are contacts. Returns the number of solves
  // that took: none where the solver has halves, else one for each contact that was none since the last factorization.
  // Returns nothing where it cannot: another factorization is cheaper, or needed, since `held` lacks unknowns that the
  // factor leaves out. Throws Cancelled.
  std::optional<int> hold(const Sides& held, const Progress* progress);

  // Returns true where the factor leaves out all that is held, and nothing else.
  bool leaves_out(const Sides& held) const;

  Vector select_left_out(const Vector& x) const;  // x (n) for the unknowns that the factor leaves out, else 0

  // Solves for x. Unknowns that the factor leaves out become 0, and contacts their entries of `at_contacts` (n, or
  // empty for 0), whatever their right-hand side. Returns the number of solves by the factor.
  int solve(Vector& x, const Vector& at_contacts = {});

  // Solves for all columns of X at once, whose entries of held unknowns are 0. Only without contacts.
  void solve(Eigen::MatrixXd& X) const { solver_.solve(X); }

 private:
  std::optional<std::vector<int>> find_contacts(const Sides& held) const;
  int add_known(const std::vector<int>& unknowns, const Progress* progress);
  void add_columns(const std::vector<int>& unknowns, const Progress* progress);
  void add_halves(const std::vector<int>& unknowns, const Progress* progress);
  Vector find_forces(Vector reached, const Vector& at_contacts) const;
  int solve_by_halves(Vector& x, const Vector& at_contacts);
  int solve_whole(Vector& x, const Vector& at_contacts);

  LinearSolver& solver_;
  SparseMatrix matrix_;
  Sides factored_;                     // n: held by the factor
  bool is_current_ = false;            // the factor is that of the matrix, without additions
  std::vector<int> contacts_;          // held besides
  std::vector<int> column_;            // their places in known_
  std::vector<int> known_;             // unknowns whose columns of the inverse were computed
  std::vector<SparseVector> half_;     // of the known ones by the lower half of the factor, where the solver has halves
  Eigen::MatrixXd inverse_;            // #known x #known: their rows and columns of the inverse
  Vector right_, lower_;               // the last right-hand side, solved with the lower half; that stays for contacts
  Eigen::LLT<Eigen::MatrixXd> schur_;  // of the contacts' rows and columns of the inverse
};

}  // namespace reflines
