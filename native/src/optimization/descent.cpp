#include "optimization/descent.h"

#include <functional>
#include <future>
#include <limits>
#include <memory>

#include "optimization/descent_run.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The tolerance of the coarse minimum: the fine factor has to do the rest anyway.
constexpr double kCoarseTolerance = 1e-2;
constexpr int kMaxCoarseIterations = 10;

// The factor of the energy below which a coarse minimum is used: dents and noise finer than the coarse basis do not
// yield to it.
constexpr double kWorthwhile = 0.9;

// The number of unknowns from which the analysis takes longer than waking a thread.
constexpr int kWorthAThread = 2000;

// Runs two functions in parallel, the first on the calling thread. Both belong to one OpenMP team: a separate thread
// for the second would run on one core with the team's idle threads, which spin for some milliseconds (10k unknowns: 48
// instead of 37 ms).
void run_in_parallel(const std::function<void()>& first, const std::function<void()>& second) {
  std::packaged_task<void()> tasks[] = {std::packaged_task<void()>(first), std::packaged_task<void()>(second)};
#pragma omp parallel for schedule(static, 1)
  for (int k = 0; k < 2; ++k) tasks[k]();  // keeps what is thrown
  for (std::packaged_task<void()>& task : tasks) task.get_future().get();
}

class Descent final : public DescentRun {
 public:
  Descent(Problem& problem, const MinimizerOptions& options, Progress* progress, Workspace& workspace)
      : DescentRun(problem, options, progress, workspace, "gradient", RefactorPolicy()) {}

 private:
  void place_start(const Vector& x) override { work_.x = x; }
  double measure_gradient() override { return work_.gradient.norm(); }
  bool factor_is_kept() const override { return work_.has_factor_of(model(), work_.x.size()); }

  // Moves the start near the minimum by the coarse problem before the first factorization: a factor at a distant start
  // needs up to 26 steps, or a second factor, one near the minimum few. The coarse problem occupies one thread, for
  // about as long as the symbolic analysis, which needs no values, takes on another.
  bool begin() override {
    if (!learns_from_steps() || factor_is_kept() || is_cancelled() || gradient_is_small()) return true;
    const SparseMatrix* pattern = problem_.size() > kWorthAThread ? problem_.pattern() : nullptr;
    int steps = 0;
    const auto move = [this, &steps] { steps = move_along_coarse(); };
    pattern != nullptr ? run_in_parallel(move, [this, pattern] { analyze(*pattern); }) : move();
    if (steps == 0) return true;
    trial_.energy = evaluate(work_.trial, work_.trial_gradient);
    if (!(trial_.energy < kWorthwhile * current_.energy)) return true;
    report_.coarse_iterations = steps;
    accept_trial();
    return true;
  }

  // Leaves the coarse minimum in the trial point; returns the steps taken, 0 where there is no coarse problem or it
  // does not help, for instance where its unknowns depend on each other on a ragged region.
  int move_along_coarse() {
    const std::unique_ptr<CoarseProblem> coarse = problem_.coarse(work_.x, work_.gradient);
    if (!coarse) return 0;
    Workspace workspace(work_.solver.kind());
    MinimizerOptions options;
    options.gradient_tolerance = kCoarseTolerance;
    options.max_iterations = kMaxCoarseIterations;
    Vector coefficients = Vector::Zero(coarse->size());
    work_.trial = work_.x;
    try {
      const Report report = descend(*coarse, coefficients, options, progress_, workspace);
      coarse->move(coefficients, work_.trial);
      return report.iterations;
    } catch (const SolverFailure&) {
      return 0;
    }
  }

  bool choose_step() override {
    if ((!factor_is_kept() || is_outdated()) && !renew_factor()) return false;
    tell("iterating");
    work_.direction = -work_.gradient;
    if (learns_from_steps()) work_.memory.before_solve(work_.direction);
    work_.solver.solve(work_.direction);
    ++report_.solves;
    if (learns_from_steps()) work_.memory.after_solve(work_.direction);
    current_.slope = work_.gradient.dot(work_.direction);
    return !step_is_rounding();
  }

  bool renew_factor() {
    const SparseMatrix& hessian = assemble();
    if (gradient_is_rounding() || is_cancelled()) return false;
    if (!work_.solver.has_pattern_of(hessian)) tell("ordering");
    analyze(hessian);
    if (is_cancelled()) return false;
    tell("factorizing");
    work_.solver.factorize(hessian, progress_);
    ++report_.factorizations;
    work_.factored_model = model();
    work_.held.clear();
    work_.held_factor.forget();
    work_.memory.clear();
    assembled_at_ = report_.iterations;
    failed_ = false;
    start_policy();
    return !is_cancelled();
  }

  void go(double step) override { work_.trial.noalias() = work_.x + step * work_.direction; }

  // Returns false for an old factor, which is wrong at a point where it leads to a refused step: a shorter one would
  // make little progress.
  bool shortens_steps() const override { return is_fresh() || !learns_from_steps(); }
  bool renews_failed() const override { return learns_from_steps(); }

  bool measure_step() override {
    work_.direction *= trial_.step;
    return true;
  }

  bool gradient_is_small() override {
    if (gradient_.now > gradient_.wanted || !moved_) return gradient_is_rounding();
    return stop(Termination::kConverged,
                format_sentence("The gradient is down to %.3g; %.3g was wanted.", gradient_.now, gradient_.wanted));
  }

  bool gradient_is_rounding() {
    if (gradient_.now > gradient_.rounding) return false;
    return stop(
        moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
        format_sentence(
            moved_ ? "The gradient is down to %.3g, which does not exceed its rounding error of %.3g."
                   : "Nothing to do: the gradient of the start, %.3g, does not exceed its rounding error of %.3g.",
            gradient_.now, gradient_.rounding));
  }

  bool step_is_rounding() {
    const double largest_step = work_.direction.lpNorm<Eigen::Infinity>();
    const double resolution = kEpsilon * work_.x.lpNorm<Eigen::Infinity>();
    if (!(largest_step <= resolution)) return false;
    return stop(moved_ ? Termination::kConverged : Termination::kAlreadyOptimal,
                format_sentence(
                    "The next step would move nothing by more than %.3g, below the resolution %.3g of the unknowns.",
                    largest_step, resolution));
  }
};

}  // namespace

Report descend(Problem& problem, Vector& x, const MinimizerOptions& options, Progress* progress, Workspace& workspace) {
  return Descent(problem, options, progress, workspace).run(x);
}

}  // namespace reflines
