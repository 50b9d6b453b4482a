#include <cholmod.h>

#include <algorithm>
#include <limits>
#include <new>
#include <optional>
#include <vector>

#include "base/parallel_failure.h"
#include "optimization/linear/elimination_path.h"
#include "optimization/linear/linear_backend.h"
#include "optimization/linear/multifrontal_cholesky.h"
#include "optimization/linear/page_prefault.h"
#include "optimization/linear/serial_loops.h"
#include "optimization/linear/triangular_solve.h"

namespace reflines {

namespace {

// The number of unknowns from which METIS orders systems whose unknowns have no places: it pays where a second factor
// is likely or memory counts. In a plane straight cuts (see dissection_order) need neither.
constexpr Eigen::Index kNestedDissection = 300000;

// CHOLMOD's order and structure of a supernodal L L^T, with 32-bit indices: they suffice for 2^31 entries of L, about
// eight million unknowns, and take less memory than 64-bit ones. Its values, and solves for one vector, are computed on
// all cores (see MultifrontalCholesky).
class Cholmod final : public LinearBackend {
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
             smallest_pivot_fraction(matrix, values) > kSmallestPivotFraction;
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
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> to_factor(B.rows());
    std::ranges::copy(places(), to_factor.indices().begin());
    std::vector<SparseColumns> result = split_columns(to_factor * B);
    run_parallel(static_cast<int>(result.size()), 1,
                 [&](int k) { result[k] = solve_along_paths(view_factor(), multifrontal_->tree(), result[k]); });
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
  double smallest_pivot_fraction(const SparseMatrix& matrix, const double* values) const {
    const SupernodalFactor L = view_factor();
    const auto* order = static_cast<const int*>(factor_->Perm);
    double smallest = std::numeric_limits<double>::infinity();
    for (int s = 0; s < L.supernode_count; ++s) {
      for (int k = 0; k < L.columns(s); ++k) {
        const double root = L.block(s)[static_cast<std::ptrdiff_t>(k) * (L.height(s) + 1)];
        smallest = std::min(smallest, root * root / values[matrix.outerIndexPtr()[order[L.first_column[s] + k]]]);
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

}  // namespace

std::shared_ptr<LinearBackend> make_cholmod_backend() { return std::make_shared<Cholmod>(); }

}  // namespace reflines
