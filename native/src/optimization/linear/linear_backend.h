// The interface of LinearSolver to the libraries that factor, and what these have in common.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "optimization/linear/sparse_columns.h"
#include "reflines/types.h"

namespace reflines {

// A library with one analysis and one factor. `factorize` returns false where a pivot is not positive.
class LinearBackend {
 public:
  virtual ~LinearBackend() = default;
  virtual void analyze(const SparseMatrix& matrix, const std::vector<int>& order) = 0;
  virtual void allocate() {}  // allocates the memory of a factor, on all cores
  virtual bool factorize(const SparseMatrix& matrix, const double* values) = 0;
  virtual void solve(Vector& x) = 0;
  virtual void solve(Eigen::MatrixXd& X) = 0;
  virtual void solve_lower(Vector&) {}
  virtual void solve_upper(Vector&) {}
  virtual std::vector<SparseColumns> solve_lower(const SparseMatrix&) { return {}; }
  virtual std::vector<int> sort_by_elimination(std::vector<int> unknowns) const { return unknowns; }

  // Factors with the first shift of the diagonal that succeeds, and returns that. Throws SolverFailure where none does.
  double factorize_shifted(const SparseMatrix& matrix);
};

std::shared_ptr<LinearBackend> make_cholmod_backend();
std::shared_ptr<LinearBackend> make_umfpack_backend();

// The smallest ratio of a pivot to its own diagonal entry: below it the pivot is rounding noise and the solution has no
// correct digit. The ratio of pivots to each other is no criterion: triangles seen nearly edge on make it 1e-17 in
// systems that lose no more than nine digits (35,040 triangles of a car body seen from above).
inline constexpr double kSmallestPivotFraction = 1e-15;

// Throws SolverFailure unless there was enough memory for a stage.
void require_memory(bool enough, const char* stage, Eigen::Index n);

// Lets one thread at a time use METIS, which draws from C's `rand` of the whole process, after a fixed seed: two
// systems ordered at once, as the coarse and the fine one of a solve are, took each other's numbers, and one order in
// some hundred had other cuts, so that the factors differed in their last bits.
std::unique_lock<std::mutex> lock_metis();

}  // namespace reflines
