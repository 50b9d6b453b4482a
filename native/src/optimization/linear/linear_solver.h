// Solves sparse symmetric positive definite systems A x = b by a direct factorization of SuiteSparse.
#pragma once

#include <memory>
#include <vector>

#include "reflines/linear_solver_kind.h"
#include "reflines/types.h"

namespace reflines {

// A matrix is handed over as its lower triangle: n x n, compressed, sorted columns, every diagonal entry present.
// The same input gives the same bits, whatever the number of threads.
class LinearSolver {
 public:
  explicit LinearSolver(LinearSolverKind kind);
  ~LinearSolver();
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  LinearSolverKind kind() const;

  // True where `matrix` has the pattern last analysed: its factorization needs no new analysis.
  bool has_pattern_of(const SparseMatrix& matrix) const;

  // Chooses the elimination order for a pattern (the values do not matter), or takes the one handed over (n, first to
  // last; CHOLMOD only). Drops a factor that is kept.
  void analyze(const SparseMatrix& matrix, const std::vector<int>& order = {});

  // Numeric factorization; the pattern must be the one analysed. A positive semi-definite matrix that breaks down is
  // tried again with a small multiple of its diagonal added (see diagonal_shift). SolverFailure where that does not
  // help.
  void factorize(const SparseMatrix& matrix);
  bool has_factor() const;
  double diagonal_shift() const;  // relative: A + shift * diag(A) is what is factored; 0 for a sound matrix

  // x <- A^-1 x with the last factor. Allocates only in the first call after `analyze`.
  void solve(Vector& x);

 private:
  class Backend;
  class Cholmod;
  class Umfpack;
  struct Pattern;
  LinearSolverKind kind_;
  std::unique_ptr<Pattern> pattern_;
  std::unique_ptr<Backend> backend_;
  bool has_factor_ = false;
  double diagonal_shift_ = 0.0;
};

}  // namespace reflines
