// Whole solves, the factorization they cannot do without, and drag updates.
#include <benchmark/benchmark.h>
#include <cblas.h>
#include <omp.h>

#include <Eigen/CholmodSupport>
#include <string>
#include <utility>

#include "optimization/linear/linear_solver.h"
#include "solver/optimizer_internals.h"
#include "tests/bench/bench.h"
#include "tests/bench/bump_cylinder.h"

namespace reflines::bench {
namespace {

void count(benchmark::State& state, const Report& report) {
  state.counters["unknowns"] = report.unknowns;
  state.counters["iterations"] = report.iterations;
  state.counters["factorizations"] = report.factorizations;
  state.counters["converged"] = report.converged();
}

// A fresh optimizer is given its target: everything a solve does, the pattern and the symbolic analysis included.
void solve(benchmark::State& state, int unknowns) {
  const BumpCylinder problem(cells_for_unknowns(unknowns));
  const std::vector<Target> target = {problem.target(0.0)};
  for (auto _ : state) {
    state.PauseTiming();
    const std::unique_ptr<ShapeOptimizer> optimizer = problem.optimizer(1.0);
    state.ResumeTiming();
    count(state, optimizer->solve(target));
  }
}

// As `solve`, with the making of the optimizer from the bare mesh.
void whole_solve(benchmark::State& state, int unknowns) {
  const BumpCylinder problem(cells_for_unknowns(unknowns));
  const std::vector<Target> target = {problem.target(0.0)};
  for (auto _ : state) {
    count(state, problem.optimizer(1.0)->solve(target));
  }
}

SparseMatrix assemble(int unknowns) {
  const BumpCylinder problem(cells_for_unknowns(unknowns));
  return problem.optimizer(1.0)->internals().hessian({problem.target(0.0)}, HessianModel::kGaussNewton);
}

// CHOLMOD's own analysis and numeric factorization as they are fastest: in the better of its orders for this size, and
// on one thread. With two in its loops and its BLAS it takes 73 instead of 23 ms at 10,000 unknowns, and 1,078 instead
// of 430 at 100,000.
void factor_with_cholmod(benchmark::State& state, int unknowns) {
  const SparseMatrix matrix = assemble(unknowns);
  openblas_set_num_threads(1);
  const int active_levels = omp_get_max_active_levels();
  omp_set_max_active_levels(0);
  for (auto _ : state) {
    Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Lower> solver;
    solver.cholmod().nmethods = 1;
    solver.cholmod().method[0].ordering = unknowns < 300000 ? CHOLMOD_AMD : CHOLMOD_METIS;
    solver.compute(matrix);
    if (solver.info() != Eigen::Success) state.SkipWithError("CHOLMOD failed");
  }
  omp_set_max_active_levels(active_levels);
  state.counters["nonzeros"] = static_cast<double>(matrix.nonZeros());
}

void factor_with_umfpack(benchmark::State& state, int unknowns) {
  const SparseMatrix matrix = assemble(unknowns);
  for (auto _ : state) {
    LinearSolver solver(LinearSolverKind::kUmfpack);
    solver.analyze(matrix);
    solver.factorize(matrix);
  }
}

// A handle is dragged: the wanted height of the bump goes up and down by a tenth, an update at a time.
void warm_step(benchmark::State& state, int unknowns) {
  const BumpCylinder problem(cells_for_unknowns(unknowns));
  const std::vector<Target> targets[2] = {{problem.target(0.4)}, {problem.target(0.5)}};
  const std::unique_ptr<ShapeOptimizer> optimizer = problem.optimizer(0.4);
  optimizer->solve(targets[1]);
  MinimizerOptions drag;
  drag.gradient_tolerance = 1e-2;
  int update = 0;
  for (auto _ : state) count(state, optimizer->solve(targets[update++ % 2], drag));
}

}  // namespace

void register_solves() {
  const auto add = [](const std::string& name, auto... arguments) {
    return benchmark::RegisterBenchmark(name.c_str(), arguments...)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  const std::pair<const char*, int> sizes[] = {{"10k", 10000}, {"100k", 100000}, {"1m", 1000000}};
  for (const auto& [size, unknowns] : sizes) {
    add(std::string("solve/") + size, solve, unknowns);
    add(std::string("whole_solve/") + size, whole_solve, unknowns);
    add(std::string("factor_cholmod/") + size, factor_with_cholmod, unknowns);
    add(std::string("factor_umfpack/") + size, factor_with_umfpack, unknowns);
    add(std::string("warm_step/") + size, warm_step, unknowns)->Iterations(10);
  }
}

}  // namespace reflines::bench
