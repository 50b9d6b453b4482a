#include "native/errors.h"
#include "native/optimization/descent.h"

namespace reflines {

namespace {

// How near the coarse minimum has to be approached: what is left is the fine factor's work anyway.
constexpr double kCoarseTolerance = 1e-1;
constexpr int kMaxCoarseIterations = 10;

// Dents and noise finer than the motions do not yield to them: a first coarse step that leaves more of the energy was
// the last.
constexpr double kWorthwhile = 0.9;

}  // namespace

// The factor of a far start misleads: on the bumps of the benchmark it took 26 steps, or a second factor. Approached
// along smooth motions first, at a fraction of the cost of a factor, the first fine factor is made near the minimum and
// 2 to 5 steps do.
void Descent::approach() {
  if (!learns_from_steps() || factor_is_kept() || is_cancelled() || gradient_is_small()) return;
  const SparseMatrix* modes = problem_.smooth_modes();
  if (modes == nullptr || modes->rows() == 0) return;
  Subspace subspace(problem_, *modes, {work_.x, work_.gradient, current_.energy});
  Vector coefficients = Vector::Zero(modes->rows());
  const int steps = descend_along(subspace, coefficients);
  if (steps == 0) return;
  measure_rounding(subspace.whole_diagonal());
  if (gradient_norm_ <= gradient_rounding_) return;
  report_.coarse_iterations = steps;
  const Subspace::Point& point = subspace.point(coefficients);
  work_.x = point.x;
  work_.gradient = point.gradient;
  current_.energy = point.energy;
  gradient_norm_ = work_.gradient.norm();
}

// The steps taken; 0 where the motions do not help, be it that they depend on each other on a ragged region.
int Descent::descend_along(Subspace& subspace, Vector& coefficients) {
  Workspace workspace(work_.solver.kind());
  MinimizerOptions options;
  options.gradient_tolerance = kCoarseTolerance;
  int steps = 0;
  for (const int limit : {1, kMaxCoarseIterations}) {
    options.max_iterations = limit;
    try {
      const Report coarse = Descent(subspace, options, progress_, workspace).run(coefficients);
      report_.assemblies += coarse.assemblies;
      report_.evaluations = 1 + subspace.evaluations();
      if (!(coarse.energy_after < kWorthwhile * report_.energy_before)) return 0;
      steps += coarse.iterations;
    } catch (const SolverFailure&) {
      return 0;
    }
  }
  return steps;
}

}  // namespace reflines
