#include <functional>
#include <future>

#include "optimization/descent.h"
#include "reflines/errors.h"

namespace reflines {

namespace {

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

}  // namespace

// Moves the start near the minimum by the coarse problem before the first factorization: a factor at a distant start
// needs up to 26 steps, or a second factor, one near the minimum few. The coarse problem occupies one thread, for about
// as long as the symbolic analysis, which needs no values, takes on another.
void Descent::approach() {
  if (!learns_from_steps() || factor_is_kept() || stopping_.is_cancelled() || gradient_is_small()) return;
  const SparseMatrix* pattern = problem_.size() > kWorthAThread ? problem_.pattern() : nullptr;
  int steps = 0;
  const auto move = [this, &steps] { steps = move_along_coarse(); };
  pattern != nullptr ? run_in_parallel(move, [this, pattern] { analyze(*pattern); }) : move();
  if (steps == 0) return;
  trial_.energy = problem_.evaluate(work_.trial, &work_.trial_gradient);
  ++report_.evaluations;
  if (!(trial_.energy < kWorthwhile * current_.energy)) return;
  report_.coarse_iterations = steps;
  accept_trial();
}

// Leaves the coarse minimum in the trial point; returns the steps taken, 0 where there is no coarse problem or it does
// not help, for instance where its unknowns depend on each other on a ragged region.
int Descent::move_along_coarse() {
  const std::unique_ptr<CoarseProblem> coarse = problem_.coarse(work_.x, work_.gradient);
  if (!coarse) return 0;
  Workspace workspace(work_.solver.kind());
  MinimizerOptions options;
  options.gradient_tolerance = kCoarseTolerance;
  options.max_iterations = kMaxCoarseIterations;
  Vector coefficients = Vector::Zero(coarse->size());
  work_.trial = work_.x;
  try {
    const Report report = Descent(*coarse, options, progress_, workspace).run(coefficients);
    coarse->move(coefficients, work_.trial);
    return report.iterations;
  } catch (const SolverFailure&) {
    return 0;
  }
}

}  // namespace reflines
