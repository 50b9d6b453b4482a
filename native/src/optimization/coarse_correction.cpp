#include <functional>
#include <future>

#include "optimization/descent.h"
#include "reflines/errors.h"

namespace reflines {

namespace {

// How near the coarse minimum has to be approached: what is left is the fine factor's work anyway.
constexpr double kCoarseTolerance = 1e-2;
constexpr int kMaxCoarseIterations = 10;

// Dents and noise finer than the motions do not yield to them: where they leave more of the energy, they are forgotten.
constexpr double kWorthwhile = 0.9;

// Unknowns from which on a thread takes less time to wake than an analysis.
constexpr int kWorthAThread = 2000;

// The first on the calling thread. Both belong to one team: a thread of its own for the second would share a core with
// the team's idle ones, which go on looking for work for some milliseconds (10k unknowns: 48 instead of 37 ms).
void side_by_side(const std::function<void()>& first, const std::function<void()>& second) {
  std::packaged_task<void()> tasks[] = {std::packaged_task<void()>(first), std::packaged_task<void()>(second)};
#pragma omp parallel for schedule(static, 1)
  for (int k = 0; k < 2; ++k) tasks[k]();  // keeps what is thrown
  for (std::packaged_task<void()>& task : tasks) task.get_future().get();
}

}  // namespace

// The factor of a far start misleads: on the bumps of the benchmark it took 26 steps, or a second factor. With a
// stand-in of few unknowns first, at one evaluation of the whole and the cost of some steps, the first factor is made
// near the minimum, and 1 to 5 steps do. The stand-in keeps one thread busy, for about as long as the symbolic analysis
// takes, which needs no values.
void Descent::approach() {
  if (!learns_from_steps() || factor_is_kept() || is_cancelled() || gradient_is_small()) return;
  const SparseMatrix* pattern = problem_.size() > kWorthAThread ? problem_.pattern() : nullptr;
  int steps = 0;
  const auto move = [this, &steps] { steps = move_along_coarse(); };
  pattern != nullptr ? side_by_side(move, [this, pattern] { analyze(*pattern); }) : move();
  if (steps == 0) return;
  trial_.energy = problem_.evaluate(work_.trial, &work_.trial_gradient);
  ++report_.evaluations;
  if (!(trial_.energy < kWorthwhile * current_.energy)) return;
  report_.coarse_iterations = steps;
  accept_trial();
}

// Leaves the place it finds in the trial point; returns the steps taken, 0 where there are no motions or they do not
// help, be it that they depend on each other on a ragged region.
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
