#include <umfpack.h>

#include <vector>

#include "optimization/linear/linear_backend.h"
#include "optimization/linear/serial_loops.h"

namespace reflines {

namespace {

// UMFPACK's L U with its symmetric strategy, for comparison with CHOLMOD by an independent factorization: whole solves
// take 2.4 times as long. The 32-bit interface overflows its work space at one million unknowns.
class Umfpack final : public LinearBackend {
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
      if (!(pivots_[k] > kSmallestPivotFraction * whole)) return false;
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

}  // namespace

std::shared_ptr<LinearBackend> make_umfpack_backend() { return std::make_shared<Umfpack>(); }

}  // namespace reflines
