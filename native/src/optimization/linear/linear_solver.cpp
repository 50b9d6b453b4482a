#include "optimization/linear/linear_solver.h"

#if !defined(REFLINES_SERIAL_BLAS)
#include <cblas.h>
#endif

#include <algorithm>
#include <mutex>
#include <vector>

#include "optimization/linear/linear_backend.h"
#include "optimization/linear/serial_loops.h"
#include "reflines/errors.h"
#include "threads/abandonable_work.h"

namespace reflines {

namespace {

// The number of unknowns from which a factorization, of 50 ms and more, may be abandoned: below it a thread and a copy
// of the matrix are not worth their time.
constexpr Eigen::Index kWorthAbandoning = 20000;

// Limits OpenBLAS to one thread: it splits its sums by the number of its threads, so that factors made with one and two
// threads differ in their last bits (measured at 10k and 100k unknowns). The fronts of a surface mesh are small: a
// second thread gained nothing in the factorization and doubled the time of a solve. The limit is set once and never
// reset: it belongs to the whole process, and resetting it while another thread solves would change that solve's
// threads.
void keep_blas_to_one_thread() {
#if !defined(REFLINES_SERIAL_BLAS)
  static std::once_flag flag;
  std::call_once(flag, [] { openblas_set_num_threads(1); });
#endif
}

std::shared_ptr<LinearBackend> make_backend(LinearSolverKind kind) {
  return kind == LinearSolverKind::kCholmod ? make_cholmod_backend() : make_umfpack_backend();
}

}  // namespace

const char* to_string(LinearSolverKind kind) { return kind == LinearSolverKind::kCholmod ? "cholmod" : "umfpack"; }

LinearSolver::LinearSolver(LinearSolverKind kind) : kind_(kind), backend_(make_backend(kind)) {}

LinearSolver::~LinearSolver() = default;

bool LinearSolver::has_pattern_of(const SparseMatrix& matrix) const {
  const int* starts = matrix.outerIndexPtr();
  const int* rows = matrix.innerIndexPtr();
  return std::equal(starts_.begin(), starts_.end(), starts, starts + matrix.outerSize() + 1) &&
         std::equal(rows_.begin(), rows_.end(), rows, rows + matrix.nonZeros());
}

// Gives work to the back end, with a matrix of its own where it may be abandoned; it is replaced then.
void LinearSolver::work(const SparseMatrix& matrix, const Progress* progress,
                        const std::function<void(LinearBackend&, const SparseMatrix&)>& task) {
  keep_blas_to_one_thread();
  has_factor_ = false;
  if (matrix.rows() < kWorthAbandoning || !may_abandon(progress)) return task(*backend_, matrix);
  try {
    run_abandonable(progress, [backend = backend_, matrix, task] { task(*backend, matrix); });
  } catch (const Cancelled&) {
    backend_ = make_backend(kind_);
    starts_.clear();
    throw;
  }
}

void LinearSolver::analyze(const SparseMatrix& matrix, const std::vector<int>& order, const Progress* progress) {
  starts_.clear();
  work(matrix, progress, [order](LinearBackend& backend, const SparseMatrix& own) { backend.analyze(own, order); });
  starts_.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1);
  rows_.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
}

void LinearSolver::factorize(const SparseMatrix& matrix, const Progress* progress) {
  const auto shift = std::make_shared<double>();
  work(matrix, progress,
       [shift](LinearBackend& backend, const SparseMatrix& own) { *shift = backend.factorize_shifted(own); });
  diagonal_shift_ = *shift;
  has_factor_ = true;
}

void LinearSolver::solve(Vector& x) { backend_->solve(x); }

void LinearSolver::solve_lower(Vector& x) { backend_->solve_lower(x); }

void LinearSolver::solve_upper(Vector& x) { backend_->solve_upper(x); }

std::vector<SparseColumns> LinearSolver::solve_lower(const SparseMatrix& B) { return backend_->solve_lower(B); }

std::vector<int> LinearSolver::sort_by_elimination(std::vector<int> unknowns) const {
  return backend_->sort_by_elimination(std::move(unknowns));
}

void LinearSolver::solve(Eigen::MatrixXd& X) {
  keep_blas_to_one_thread();
  const SerialLoops serial_loops;
  backend_->solve(X);
}

}  // namespace reflines
