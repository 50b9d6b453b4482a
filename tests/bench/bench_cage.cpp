// A dented cage of 2,025 vertices smoothed at level 3, the same surface as a mesh of its own, and drag updates.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "reflines/cage_optimizer.h"
#include "reflines/smooth_target.h"
#include "tests/bench/bench.h"

namespace reflines::bench {
namespace {

constexpr int kCells = 44;
constexpr int kLevel = 3;
const Vector3 kView = Vector3(0, -0.5, 1).normalized();
const Vector3 kLines(0, 1, 0.1);
const SmoothOptions kSmoothing{0.15, false};  // five faces of the cage

// A bonnet of 1.4 x 1.2 whose vertices lie up to 1e-3 wrong.
Positions bonnet() {
  Positions V((kCells + 1) * (kCells + 1), 3);
  for (int v = 0; v < V.rows(); ++v) {
    const double x = 1.4 * (v % (kCells + 1)) / kCells - 0.7, y = 1.2 * (v / (kCells + 1)) / kCells - 0.6;
    const double dents = 1e-3 * std::sin(37.0 * v) * std::sin(11.0 * v + 2);
    V.row(v) << x, y, -0.13 * x * x - 0.14 * std::pow(x, 4) - 0.06 * y * y + 0.1 * y + dents;
  }
  return V;
}

Cage cage() {
  Eigen::MatrixXi quads(kCells * kCells, 4);
  for (int f = 0; f < quads.rows(); ++f) {
    const int a = f / kCells * (kCells + 1) + f % kCells;
    quads.row(f) << a, a + 1, a + kCells + 2, a + kCells + 1;
  }
  return cage_from_faces((kCells + 1) * (kCells + 1), quads);
}

std::unique_ptr<CageOptimizer> cage_optimizer(bool sparse) {
  CageOptions options;
  options.subdivision.level = kLevel;
  options.sparse = sparse;
  return std::make_unique<CageOptimizer>(cage(), bonnet(), kView, std::vector<Vector3>{kLines}, options);
}

Target smooth_target(ShapeOptimizer& optimizer, double strength) {
  return build_smooth_target(optimizer.field(0), optimizer.smoother(0), kSmoothing, strength, 0);
}

void count(benchmark::State& state, const Report& report) {
  state.counters["unknowns"] = report.unknowns;
  state.counters["iterations"] = report.iterations;
  state.counters["converged"] = report.converged();
}

// A fresh optimizer is given its target.
void cage_solve(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    const std::unique_ptr<CageOptimizer> optimizer = cage_optimizer(false);
    const std::vector<Target> target = {smooth_target(optimizer->surface(), 1.0)};
    state.ResumeTiming();
    count(state, optimizer->surface().solve(target));
  }
}

// The same triangles and the same target, with a height for each vertex.
void dense_solve(benchmark::State& state) {
  const std::unique_ptr<CageOptimizer> cage = cage_optimizer(false);
  const std::vector<Target> target = {smooth_target(cage->surface(), 1.0)};
  for (auto _ : state) {
    state.PauseTiming();
    ShapeOptimizer dense(cage->surface().positions(), cage->triangles(), kView, {kLines});
    state.ResumeTiming();
    count(state, dense.solve(target));
  }
}

// What a drag of the smoothing's strength does for every move of the mouse: the target, and the shape after it.
void cage_warm_step(benchmark::State& state) {
  const std::unique_ptr<CageOptimizer> start = cage_optimizer(false), follower = cage_optimizer(true);
  follower->surface().solve({smooth_target(start->surface(), 0.5)});
  MinimizerOptions drag;
  drag.gradient_tolerance = 1e-2;
  int update = 0;
  for (auto _ : state) {
    const double strength = update++ % 2 == 0 ? 0.6 : 0.5;
    count(state, follower->surface().solve({smooth_target(start->surface(), strength)}, drag));
    benchmark::DoNotOptimize(follower->cage_positions());
  }
}

}  // namespace

void register_cages() {
  const auto add = [](const char* name, auto run) {
    return benchmark::RegisterBenchmark(name, run)->Iterations(1)->Unit(benchmark::kMillisecond)->UseRealTime();
  };
  add("cage_solve", cage_solve);
  add("dense_solve", dense_solve);
  add("cage_warm_step", cage_warm_step)->Iterations(10);
}

}  // namespace reflines::bench
