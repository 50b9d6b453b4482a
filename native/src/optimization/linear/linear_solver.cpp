#include "optimization/linear/linear_solver.h"

#if !defined(REFLINES_SERIAL_BLAS)
#include <cblas.h>
#endif
#include <cholmod.h>
#include <omp.h>
#include <umfpack.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel_failure.h"
#include "optimization/linear/elimination_path.h"
#include "optimization/linear/multifrontal_cholesky.h"
#include "optimization/linear/page_prefault.h"
#include "optimization/linear/triangular_solve.h"
#include "reflines/errors.h"
#include "threads/abandonable_work.h"

namespace reflines {

namespace {

// The multiples of the diagonal that are added one after the other until the factorization succeeds, and of the mean
// diagonal entry for unknowns that no term constrains. A Gauss-Newton matrix is semi-definite on paper: 1e-12 is above
// the rounding of a sum of some thousand terms, 1e-9 is for very thin triangles, and the last two, which shorten the
// steps, for free borders around faces seen nearly edge on.
constexpr double kDiagonalShifts[] = {0.0, 1e-12, 1e-9, 1e-6, 1e-3};

// The smallest ratio of a pivot to its own diagonal entry: below it the pivot is rounding noise and the solution has no
// correct digit. The ratio of pivots to each other is no criterion: triangles seen nearly edge on make it 1e-17 in
// systems that lose no more than nine digits (35,040 triangles of a car body seen from above).
constexpr double kSmallestPivotShare = 1e-15;

// The number of unknowns from which METIS orders systems whose unknowns have no places: it pays where a second factor
// is likely or memory counts. In a plane straight cuts (see dissection_order) need neither.
constexpr Eigen::Index kNestedDissection = 300000;

// The number of unknowns from which a factorization, of 50 ms and more, may be abandoned: below it a thread and a copy
// of the matrix are not worth their time.
constexpr Eigen::Index kWorthAbandoning = 20000;

// The number of columns of a sparse right-hand side that are solved together.
constexpr int kColumnsAtOnce = 4;

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

// Makes CHOLMOD's own loops serial for a scope: they request four threads on any machine. On two cores they take as
// long as one thread, and each team of another size makes OpenMP end and start threads: some milliseconds. The setting
// belongs to the calling thread; before GCC 12 it belonged to the process, so that a thread of a team, whose loops are
// serial anyway, does not change it.
class SerialLoops {
 public:
  SerialLoops() : active_levels_(omp_get_max_active_levels()) { set(0); }
  ~SerialLoops() { set(active_levels_); }
  SerialLoops(const SerialLoops&) = delete;
  SerialLoops& operator=(const SerialLoops&) = delete;

 private:
  static void set(int active_levels) {
    if (!omp_in_parallel()) omp_set_max_active_levels(active_levels);
  }

  int active_levels_;
};

// Lets one thread at a time use METIS, which draws from C's `rand` of the whole process, after a fixed seed: two
// systems ordered at once, as the coarse and the fine one of a solve are, took each other's numbers, and one order in
// some hundred had other cuts, so that the factors differed in their last bits.
std::unique_lock<std::mutex> lock_metis() {
  static std::mutex mutex;
  return std::unique_lock(mutex);
}

void require_memory(bool enough, const char* stage, Eigen::Index n) {
  if (enough) return;
  throw SolverFailure("Memory ran out while " + std::string(stage) + " a system of " + std::to_string(n) +
                      " unknowns; optimize a smaller region.");
}

Vector shift_diagonal(const SparseMatrix& matrix, double shift) {
  Vector values = Eigen::Map<const Vector>(matrix.valuePtr(), matrix.nonZeros());
  const double mean = matrix.diagonal().mean();
  for (int column = 0; column < matrix.cols(); ++column) {
    double& entry = values[matrix.outerIndexPtr()[column]];
    entry += shift * (entry + mean);
  }
  return values;
}

}  // namespace

const char* to_string(LinearSolverKind kind) { return kind == LinearSolverKind::kCholmod ? "cholmod" : "umfpack"; }

// The interface of the two libraries. `factorize` returns false where a pivot is not positive.
class LinearSolver::Backend {
 public:
  virtual ~Backend() = default;
  virtual void analyze(const SparseMatrix& matrix, const std::vector<int>& order) = 0;
  virtual void allocate() {}  // allocates the memory of a factor, on all cores
  virtual bool factorize(const SparseMatrix& matrix, const double* values) = 0;
  virtual void solve(Vector& x) = 0;
  virtual void solve(Eigen::MatrixXd& X) = 0;
  virtual void solve_lower(Vector&) {}
  virtual void solve_upper(Vector&) {}
  virtual std::vector<SparseColumns> solve_lower(const SparseMatrix&) { return {}; }
  virtual std::vector<int> sort_by_elimination(std::vector<int> unknowns) const { return unknowns; }

  // Factors with the first shift that succeeds and returns that.
  double factorize_shifted(const SparseMatrix& matrix) {
    allocate();
    Vector shifted;
    for (const double shift : kDiagonalShifts) {
      if (shift > 0.0) shifted = shift_diagonal(matrix, shift);
      if (factorize(matrix, shift > 0.0 ? shifted.data() : matrix.valuePtr())) return shift;
    }
    throw SolverFailure(
        "The system of " + std::to_string(matrix.rows()) +
        " unknowns is singular or not positive definite, also with 1e-3 of its diagonal added; hold more of "
        "the border.");
  }

  static std::shared_ptr<Backend> make(LinearSolverKind kind);
};

// CHOLMOD's order and structure of a supernodal L L^T, with 32-bit indices: they suffice for 2^31 entries of L, about
// eight million unknowns, and take less memory than 64-bit ones. Its values, and solves for one vector, are computed on
// all cores (see MultifrontalCholesky).
class LinearSolver::Cholmod final : public Backend {
 public:
  Cholmod() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.postorder = 1;
  }
  ~Cholmod() override {
    for (cholmod_dense* dense : {solution_, y_, e_}) cholmod_free_dense(&dense, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void analyze(const SparseMatrix& matrix, const std::vector<int>& order) override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_sparse view = wrap_matrix(matrix, matrix.valuePtr());
    common_.method[0].ordering = !order.empty()                      ? CHOLMOD_GIVEN
                                 : matrix.rows() < kNestedDissection ? CHOLMOD_AMD
                                                                     : CHOLMOD_METIS;
    {
      const SerialLoops serial_loops;
      const auto lock = common_.method[0].ordering == CHOLMOD_METIS ? lock_metis() : std::unique_lock<std::mutex>();
      factor_ = cholmod_analyze_p(&view, const_cast<int*>(order.data()), nullptr, 0, &common_);
    }
    require_memory(factor_ != nullptr, "ordering", matrix.rows());
    multifrontal_.emplace(view_factor(), matrix, static_cast<const int*>(factor_->Perm));
  }

  void allocate() override {
    if (factor_->xtype != CHOLMOD_PATTERN) return;
    const int done = cholmod_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor_, &common_);
    require_memory(done != 0, "factorizing", static_cast<Eigen::Index>(factor_->n));
    provide_pages(factor_->x, factor_->xsize * sizeof(double));
    triangular_solve_.emplace(view_factor(), multifrontal_->tree());
  }

  bool factorize(const SparseMatrix& matrix, const double* values) override {
    factor_->minor = factor_->n;  // CHOLMOD's mark of a factor without a failed pivot
    try {
      return multifrontal_->factorize(values, static_cast<double*>(factor_->x)) &&
             smallest_pivot_share(matrix, values) > kSmallestPivotShare;
    } catch (const std::bad_alloc&) {
      require_memory(false, "factorizing", matrix.rows());
      return false;
    }
  }

  void solve(Vector& x) override {
    solve_lower(x);
    solve_upper(x);
  }

  void solve_lower(Vector& x) override {
    const auto* order = static_cast<const int*>(factor_->Perm);
    permuted_.resize(x.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) permuted_(j) = x(order[j]);
    x.swap(permuted_);
    triangular_solve_->solve_lower(x);
  }

  void solve_upper(Vector& x) override {
    triangular_solve_->solve_upper(x);
    const auto* order = static_cast<const int*>(factor_->Perm);
    permuted_.resize(x.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) permuted_(order[j]) = x(j);
    x.swap(permuted_);
  }

  void solve(Eigen::MatrixXd& X) override {
    cholmod_dense right_side{};
    right_side.nrow = right_side.d = static_cast<std::size_t>(X.rows());
    right_side.ncol = static_cast<std::size_t>(X.cols());
    right_side.nzmax = static_cast<std::size_t>(X.size());
    right_side.x = X.data();
    right_side.xtype = CHOLMOD_REAL;
    right_side.dtype = CHOLMOD_DOUBLE;
    const int done = cholmod_solve2(CHOLMOD_A, factor_, &right_side, nullptr, &solution_, nullptr, &y_, &e_, &common_);
    require_memory(done != 0, "solving", X.rows());
    std::copy_n(static_cast<const double*>(solution_->x), X.size(), X.data());
  }

  std::vector<SparseColumns> solve_lower(const SparseMatrix& B) override {
    const EliminationPaths paths(view_factor());
    const std::vector<int> place = places();
    std::vector<SparseColumns> result((B.cols() + kColumnsAtOnce - 1) / kColumnsAtOnce);
    const auto solve_some = [&](int k, std::vector<int>& scratch) {
      const int first = k * kColumnsAtOnce, count = std::min(kColumnsAtOnce, static_cast<int>(B.cols()) - first);
      std::vector<EliminationPaths::Entry> entries;
      for (int j = 0; j < count; ++j) {
        for (SparseMatrix::InnerIterator entry(B, first + j); entry; ++entry)
          entries.push_back({place[entry.row()], j, entry.value()});
      }
      result[k] = paths.solve(entries, count, scratch);
    };
    ParallelFailure failure;
#pragma omp parallel if (result.size() > 1)
    {
      std::vector<int> scratch;
      failure.run([&] { scratch.resize(place.size()); });
#pragma omp for schedule(dynamic)
      for (int k = 0; k < static_cast<int>(result.size()); ++k) failure.run([&] { solve_some(k, scratch); });
    }
    failure.rethrow();
    return result;
  }

  std::vector<int> sort_by_elimination(std::vector<int> unknowns) const override {
    const std::vector<int> place = places();
    std::sort(unknowns.begin(), unknowns.end(), [&](int a, int b) { return place[a] < place[b]; });
    return unknowns;
  }

 private:
  std::vector<int> places() const {  // of the unknowns in the factor
    std::vector<int> place(factor_->n);
    const auto* order = static_cast<const int*>(factor_->Perm);
    for (int j = 0; j < static_cast<int>(place.size()); ++j) place[order[j]] = j;
    return place;
  }

  SupernodalFactor view_factor() const {
    return {static_cast<int>(factor_->n),
            static_cast<int>(factor_->nsuper),
            static_cast<const int*>(factor_->super),
            static_cast<const int*>(factor_->pi),
            static_cast<const int*>(factor_->px),
            static_cast<const int*>(factor_->s),
            static_cast<double*>(factor_->x)};
  }

  // Returns the smallest L_jj^2 / A_jj. Columns of a supernode lie one below the other, each as high as the first.
  double smallest_pivot_share(const SparseMatrix& matrix, const double* values) const {
    const SupernodalFactor L = view_factor();
    const auto* order = static_cast<const int*>(factor_->Perm);
    double smallest = std::numeric_limits<double>::infinity();
    for (int s = 0; s < L.supernode_count; ++s) {
      const auto height = static_cast<std::size_t>(L.row_start[s + 1] - L.row_start[s]);
      for (int j = L.first_column[s]; j < L.first_column[s + 1]; ++j) {
        const auto column = static_cast<std::size_t>(j - L.first_column[s]);
        const double root = L.value[static_cast<std::size_t>(L.block_start[s]) + column * (height + 1)];
        smallest = std::min(smallest, root * root / values[matrix.outerIndexPtr()[order[j]]]);
      }
    }
    return smallest;
  }

  // Returns CHOLMOD's view of Eigen's arrays, without a copy.
  static cholmod_sparse wrap_matrix(const SparseMatrix& matrix, const double* values) {
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(matrix.rows());
    view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
    view.p = const_cast<int*>(matrix.outerIndexPtr());
    view.i = const_cast<int*>(matrix.innerIndexPtr());
    view.x = const_cast<double*>(values);
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    return view;
  }

  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* y_ = nullptr;
  cholmod_dense* e_ = nullptr;
  std::optional<TriangularSolve> triangular_solve_;
  std::optional<MultifrontalCholesky> multifrontal_;
  Vector permuted_;
};

// UMFPACK's L U with its symmetric strategy, for comparison with CHOLMOD by an independent factorization: whole solves
// take 2.4 times as long. The 32-bit interface overflows its work space at one million unknowns.
class LinearSolver::Umfpack final : public Backend {
 public:
  Umfpack() {
    umfpack_dl_defaults(control_);
    control_[UMFPACK_PRL] = 0;
    control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    control_[UMFPACK_IRSTEP] = 0;  // refinement makes a solve four times slower and a Newton step no better
    control_[UMFPACK_SYM_PIVOT_TOLERANCE] =
        0;  // diagonal pivots are stable for a definite matrix, and their signs tell
    control_[UMFPACK_SCALE] = UMFPACK_SCALE_NONE;  // row scaling would make the matrix unsymmetric
  }
  ~Umfpack() override {
    umfpack_dl_free_numeric(&numeric_);
    umfpack_dl_free_symbolic(&symbolic_);
  }
  Umfpack(const Umfpack&) = delete;
  Umfpack& operator=(const Umfpack&) = delete;

  void analyze(const SparseMatrix& matrix, const std::vector<int>&) override {
    umfpack_dl_free_numeric(&numeric_);
    umfpack_dl_free_symbolic(&symbolic_);
    mirror_pattern(matrix);
    const auto n = static_cast<SuiteSparse_long>(matrix.rows());
    const SerialLoops serial_loops;
    const auto lock = lock_metis();
    const auto status = umfpack_dl_symbolic(n, n, starts_.data(), rows_.data(), nullptr, &symbolic_, control_, info_);
    require_memory(status == UMFPACK_OK, "ordering", matrix.rows());
    right_side_.resize(matrix.rows());
    work_.resize(matrix.rows());
    index_work_.resize(static_cast<std::size_t>(n));
    pivots_.resize(matrix.rows());
    column_of_pivot_.resize(static_cast<std::size_t>(n));
  }

  bool factorize(const SparseMatrix& matrix, const double* values) override {
    umfpack_dl_free_numeric(&numeric_);
    for (std::size_t k = 0; k < source_.size(); ++k) values_[k] = values[source_[k]];
    const auto status =
        umfpack_dl_numeric(starts_.data(), rows_.data(), values_.data(), symbolic_, &numeric_, control_, info_);
    require_memory(status >= UMFPACK_OK, "factorizing", matrix.rows());
    if (status != UMFPACK_OK) return false;
    umfpack_dl_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, column_of_pivot_.data(),
                           pivots_.data(), nullptr, nullptr, numeric_);
    for (Eigen::Index k = 0; k < pivots_.size(); ++k) {
      const double whole = values[matrix.outerIndexPtr()[column_of_pivot_[static_cast<std::size_t>(k)]]];
      if (!(pivots_[k] > kSmallestPivotShare * whole)) return false;
    }
    return true;
  }

  void solve(Vector& x) override { solve_column(x.data()); }

  void solve(Eigen::MatrixXd& X) override {
    for (Eigen::Index j = 0; j < X.cols(); ++j) solve_column(X.col(j).data());
  }

 private:
  void solve_column(double* x) {
    right_side_ = Eigen::Map<const Vector>(x, right_side_.size());
    umfpack_dl_wsolve(UMFPACK_A, starts_.data(), rows_.data(), values_.data(), x, right_side_.data(), numeric_,
                      control_, info_, index_work_.data(), work_.data());
  }

  // Builds the pattern of both triangles, which UMFPACK needs; source_ maps each entry to a value of the lower one.
  void mirror_pattern(const SparseMatrix& lower) {
    const int n = static_cast<int>(lower.cols());
    starts_.assign(static_cast<std::size_t>(n) + 1, 0);
    for (int column = 0; column < n; ++column) {
      for (SparseMatrix::InnerIterator entry(lower, column); entry; ++entry) {
        ++starts_[entry.row() + 1];
        if (entry.row() != column) ++starts_[column + 1];
      }
    }
    for (int column = 0; column < n; ++column) starts_[column + 1] += starts_[column];
    rows_.resize(static_cast<std::size_t>(starts_[n]));
    source_.resize(rows_.size());
    values_.resize(rows_.size());
    std::vector<SuiteSparse_long> next(starts_.begin(), starts_.end() - 1);
    // Columns in ascending order leave every column of the mirror sorted: first its rows above, then those below.
    for (int column = 0; column < n; ++column) {
      for (int k = lower.outerIndexPtr()[column]; k < lower.outerIndexPtr()[column + 1]; ++k) {
        place(next, lower.innerIndexPtr()[k], column, k);
      }
    }
  }

  void place(std::vector<SuiteSparse_long>& next, int row, int column, int source) {
    const SuiteSparse_long below = next[column]++;
    rows_[below] = row;
    source_[below] = source;
    if (row == column) return;
    const SuiteSparse_long above = next[row]++;
    rows_[above] = column;
    source_[above] = source;
  }

  double control_[UMFPACK_CONTROL];
  double info_[UMFPACK_INFO];
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  std::vector<SuiteSparse_long> starts_, rows_, index_work_, column_of_pivot_;
  std::vector<int> source_;
  std::vector<double> values_;
  Vector right_side_, work_, pivots_;
};

struct LinearSolver::Pattern {
  std::vector<int> starts, rows;
};

std::shared_ptr<LinearSolver::Backend> LinearSolver::Backend::make(LinearSolverKind kind) {
  if (kind == LinearSolverKind::kCholmod) return std::make_shared<Cholmod>();
  return std::make_shared<Umfpack>();
}

LinearSolver::LinearSolver(LinearSolverKind kind)
    : kind_(kind), pattern_(std::make_unique<Pattern>()), backend_(Backend::make(kind)) {}

LinearSolver::~LinearSolver() = default;

LinearSolverKind LinearSolver::kind() const { return kind_; }
bool LinearSolver::has_factor() const { return has_factor_; }
double LinearSolver::diagonal_shift() const { return diagonal_shift_; }

bool LinearSolver::has_pattern_of(const SparseMatrix& matrix) const {
  const int* starts = matrix.outerIndexPtr();
  const int* rows = matrix.innerIndexPtr();
  return std::equal(pattern_->starts.begin(), pattern_->starts.end(), starts, starts + matrix.outerSize() + 1) &&
         std::equal(pattern_->rows.begin(), pattern_->rows.end(), rows, rows + matrix.nonZeros());
}

// Gives work to the back end, with a matrix of its own where it may be abandoned; it is replaced then.
void LinearSolver::work(const SparseMatrix& matrix, const Progress* progress,
                        const std::function<void(Backend&, const SparseMatrix&)>& task) {
  keep_blas_to_one_thread();
  has_factor_ = false;
  if (matrix.rows() < kWorthAbandoning || !may_abandon(progress)) return task(*backend_, matrix);
  try {
    run_abandonable(progress, [backend = backend_, matrix, task] { task(*backend, matrix); });
  } catch (const Cancelled&) {
    backend_ = Backend::make(kind_);
    pattern_->starts.clear();
    throw;
  }
}

void LinearSolver::analyze(const SparseMatrix& matrix, const std::vector<int>& order, const Progress* progress) {
  pattern_->starts.clear();
  work(matrix, progress, [order](Backend& backend, const SparseMatrix& own) { backend.analyze(own, order); });
  pattern_->starts.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1);
  pattern_->rows.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
}

void LinearSolver::factorize(const SparseMatrix& matrix, const Progress* progress) {
  const auto shift = std::make_shared<double>();
  work(matrix, progress,
       [shift](Backend& backend, const SparseMatrix& own) { *shift = backend.factorize_shifted(own); });
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
