// The strategies against each other: the time to the same energy (Figure 7 of the paper).
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/bench/bench.h"
#include "tests/bench/bump_cylinder.h"

namespace reflines::bench {
namespace {

constexpr int kMostSteps = 256;

// "Solved": this share of the energy that can be gained at all is still there. At 1e-8 the heights differ by some 1e-4
// of the bump from those of the minimum: nothing that a picture shows. At 1e-3 an artist sees that it begins to fit.
struct Goal {
  const char* name;  // appended to that of the benchmark
  double energy_left;
};
constexpr Goal kGoal = {"", 1e-8};
constexpr Goal kEarlyGoals[] = {{"/1e-3", 1e-3}, {"/1e-5", 1e-5}};

// Creation goes from the plain cylinder to the bump, elimination back.
struct Task {
  const char* name;
  double from, to;
};
constexpr Task kTasks[] = {{"creation", 0.0, 1.0}, {"elimination", 1.0, 0.0}};

MinimizerOptions stopping_after(Strategy strategy, int steps) {
  MinimizerOptions options;
  options.strategy = strategy;
  options.gradient_tolerance = 1e-12;
  options.max_iterations = steps;
  return options;
}

Report run(const BumpCylinder& problem, const Task& task, Strategy strategy, int steps) {
  return problem.optimizer(task.from)->solve({problem.target(task.to)}, stopping_after(strategy, steps));
}

// The fewest steps that bring the energy down to `wanted`, or kMostSteps. Runs are deterministic and their energies
// fall.
int steps_to_energy(const BumpCylinder& problem, const Task& task, Strategy strategy, double wanted) {
  const auto reached = [&](int steps) { return run(problem, task, strategy, steps).energy_after <= wanted; };
  int high = 1;
  while (high < kMostSteps && !reached(high)) high *= 2;
  if (high >= kMostSteps) return kMostSteps;
  int low = high / 2;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

// One strategy on one problem. The steps it needs are counted once and hold for every repetition.
struct Race {
  Task task;
  Strategy strategy;
  int cells;
  Goal goal = kGoal;
  int steps = 0;
  double wanted_energy = 0.0;

  void prepare(const BumpCylinder& problem) {
    if (steps > 0) return;
    const Report best = bench::run(problem, task, Strategy::kGaussNewton, 30);
    wanted_energy = best.energy_after + goal.energy_left * (best.energy_before - best.energy_after);
    steps = steps_to_energy(problem, task, strategy, wanted_energy);
  }

  void run(benchmark::State& state) {
    const BumpCylinder problem(cells);
    prepare(problem);
    const std::vector<Target> target = {problem.target(task.to)};
    Report report;
    for (auto _ : state) {
      state.PauseTiming();
      const std::unique_ptr<ShapeOptimizer> optimizer = problem.optimizer(task.from);
      state.ResumeTiming();
      report = optimizer->solve(target, stopping_after(strategy, steps));
    }
    state.counters["unknowns"] = report.unknowns;
    state.counters["iterations"] = report.iterations;
    state.counters["factorizations"] = report.factorizations;
    state.counters["reached"] = report.energy_after <= wanted_energy;
  }
};

}  // namespace

void register_race(const Race& given) {
  const std::string name = std::string("strategy/") + given.task.name + "/" + to_string(given.strategy) + "/" +
                           std::to_string(given.cells) + given.goal.name;
  const auto race = std::make_shared<Race>(given);
  benchmark::RegisterBenchmark(name.c_str(), [race](benchmark::State& state) { race->run(state); })
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void register_strategies() {
  for (const Task& task : kTasks) {
    for (const int cells : {32, 64, 128, 256}) {
      for (const Strategy strategy :
           {Strategy::kAdaptive, Strategy::kLinearized, Strategy::kGaussNewton, Strategy::kNewton}) {
        register_race({task, strategy, cells});
      }
      for (const Goal& goal : kEarlyGoals) {
        for (const Strategy strategy : {Strategy::kAdaptive, Strategy::kLinearized})
          register_race({task, strategy, cells, goal});
      }
    }
  }
}

}  // namespace reflines::bench
