// Solves sparse symmetric positive definite systems A x = b by a direct factorization, analysed by SuiteSparse.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "optimization/linear/sparse_columns.h"
#include "reflines/linear_solver_kind.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

class LinearBackend;

// A factorization with its symbolic analysis. Matrices are lower triangles: n x n, compressed, sorted columns, every
// diagonal entry present. The same input gives the same bits, whatever the number of threads. The libraries cannot be
// interrupted: with a `progress` (it may be null) `analyze` and `factorize` of large systems throw Cancelled soon after
// its cancellation, and go on in a thread that nobody waits for (see run_abandonable). There is no factor then.
class LinearSolver {
 public:
  explicit LinearSolver(LinearSolverKind kind);
  ~LinearSolver();
  LinearSolver(const LinearSolver&) = delete;
  LinearSolver& operator=(const LinearSolver&) = delete;

  LinearSolverKind kind() const { return kind_; }

  // Returns whether `matrix` has the pattern last analysed: its factorization needs no new analysis.
  bool has_pattern_of(const SparseMatrix& matrix) const;

  // Chooses the elimination order for a pattern (the values do not matter), or takes the given one (n, first to last;
  // CHOLMOD only). Deletes the present factor.
  void analyze(const SparseMatrix& matrix, const std::vector<int>& order = {}, const Progress* progress = nullptr);

  // Factors a matrix whose pattern is the one analysed. A positive semi-definite matrix whose factorization fails is
  // tried again with a small multiple of its diagonal added (see diagonal_shift). Throws SolverFailure where that does
  // not help.
  void factorize(const SparseMatrix& matrix, const Progress* progress = nullptr);
  bool has_factor() const { return has_factor_; }
  void forget_factor() { has_factor_ = false; }  // the analysis stays
  double diagonal_shift() const {
    return diagonal_shift_;
  }  // shift of the factored A + shift * diag(A); 0 for a sound matrix

  // Solves x <- A^-1 x with the last factor. Allocates only in the first call after `analyze`.
  void solve(Vector& x);
  // Solves for all columns of X (n x any number) at once: 16 take a third of the time of as many single solves.
  void solve(Eigen::MatrixXd& X);

  // Returns whether the factor is P A P^T = L L^T, whose halves can be used by themselves: CHOLMOD's.
  bool has_halves() const { return kind_ == LinearSolverKind::kCholmod; }

  // Solves with one half: x <- L^-1 P x, and x <- P^T L^-T x. Both together make a solve.
  void solve_lower(Vector& x);
  void solve_upper(Vector& x);

  // Returns L^-1 P B for sparse columns B (n x any number), as blocks of neighbouring columns in B's order. 64 unit
  // vectors that are sorted by elimination take as long as one or two solves.
  std::vector<SparseColumns> solve_lower(const SparseMatrix& B);

  // Returns the unknowns in the order of elimination: neighbours follow each other, and have most of their paths in
  // common.
  std::vector<int> sort_by_elimination(std::vector<int> unknowns) const;

 private:
  void work(const SparseMatrix& matrix, const Progress* progress,
            const std::function<void(LinearBackend&, const SparseMatrix&)>& task);

  LinearSolverKind kind_;
  std::vector<int> starts_, rows_;  // the pattern last analysed
  std::shared_ptr<LinearBackend> backend_;
  bool has_factor_ = false;
  double diagonal_shift_ = 0.0;
};

}  // namespace reflines
