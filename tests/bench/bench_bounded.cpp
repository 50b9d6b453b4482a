// Solves within a limit of the move, and the free ones that they are compared with.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <numbers>
#include <random>
#include <string>
#include <thread>
#include <utility>

#include "tests/bench/bench.h"
#include "tests/bench/bump_cylinder.h"

namespace reflines::bench {
namespace {

const Vector3 kView = Vector3::UnitZ();
const Vector3 kLines(0.0, std::cos(std::numbers::pi / 9), std::sin(std::numbers::pi / 9));

// The cylinder with a bump and noise of a hundredth of a cell, as a scan has it.
struct NoisyBump {
  explicit NoisyBump(int unknowns) : problem(cells_for_unknowns(unknowns)), V(problem.positions(0.1)) {
    std::mt19937 random(11);
    const double amplitude = 0.01 / cells_for_unknowns(unknowns);
    for (Eigen::Index v = 0; v < V.rows(); ++v) V(v, 2) += amplitude * (2 * (random() / 4294967296.0) - 1);
    largest = optimizer()->solve({problem.target(0.0)}).largest_move;
  }
  std::unique_ptr<ShapeOptimizer> optimizer() const {
    return std::make_unique<ShapeOptimizer>(V, problem.triangles(), kView, std::vector<Vector3>{kLines});
  }
  MoveLimit limit(double share_of_largest) const {
    return MoveLimit::within(share_of_largest * largest, static_cast<int>(V.rows()));
  }

  BumpCylinder problem;
  Positions V;
  double largest = 0.0;  // of the free solve
};

constexpr auto kLongest = std::chrono::seconds(40);  // of one solve; with 100,000 vertices some take longer

// Cancels a progress after the longest time, unless it is destroyed before.
class TimeLimit {
 public:
  TimeLimit()
      : watch_([this](const std::stop_token& stop) {
          std::unique_lock lock(mutex_);
          if (!ended_.wait_for(lock, stop, kLongest, [&] { return stop.stop_requested(); })) progress_.cancel();
        }) {}
  Progress* progress() { return &progress_; }

 private:
  Progress progress_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::jthread watch_;  // last: it ends before what it uses
};

void count(benchmark::State& state, const Report& report) {
  state.counters["iterations"] = report.iterations;
  state.counters["factorizations"] = report.factorizations;
  state.counters["solves"] = report.solves;
  state.counters["converged"] = report.converged();
  state.counters["touching"] = report.limited_fraction;
}

void solve(benchmark::State& state, int unknowns, double share) {
  const NoisyBump bump(unknowns);
  const std::vector<Target> target = {bump.problem.target(0.0)};
  for (auto _ : state) {
    state.PauseTiming();
    const std::unique_ptr<ShapeOptimizer> optimizer = bump.optimizer();
    const MoveLimit limit = share > 0 ? bump.limit(share) : MoveLimit::none();
    TimeLimit time;
    state.ResumeTiming();
    count(state, optimizer->solve(target, {}, time.progress(), limit));
  }
}

// As warm_step, within a limit.
void warm_step(benchmark::State& state, int unknowns, double share) {
  const NoisyBump bump(unknowns);
  const std::vector<Target> targets[2] = {{bump.problem.target(0.0)}, {bump.problem.target(0.01)}};
  const std::unique_ptr<ShapeOptimizer> optimizer = bump.optimizer();
  const MoveLimit limit = share > 0 ? bump.limit(share) : MoveLimit::none();
  TimeLimit time;
  if (optimizer->solve(targets[1], {}, time.progress(), limit).termination == Termination::kCancelled)
    return state.SkipWithError("the first solve does not end");
  MinimizerOptions drag;
  drag.gradient_tolerance = 1e-2;
  int update = 0;
  for (auto _ : state) count(state, optimizer->solve(targets[update++ % 2], drag, nullptr, limit));
}

}  // namespace

void register_bounded() {
  const auto add = [](const std::string& name, auto... arguments) {
    return benchmark::RegisterBenchmark(name.c_str(), arguments...)
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  const std::pair<const char*, int> sizes[] = {{"10k", 10000}, {"100k", 100000}};
  const std::pair<const char*, double> shares[] = {{"free", 0.0}, {"10", 0.3}, {"50", 0.1}, {"90", 0.01}};
  for (const auto& [size, unknowns] : sizes) {
    for (const auto& [percent, share] : shares) {
      add(std::string("bounded/") + size + "/" + percent, solve, unknowns, share);
      add(std::string("bounded_warm_step/") + size + "/" + percent, warm_step, unknowns, share)->Iterations(10);
    }
  }
}

}  // namespace reflines::bench
