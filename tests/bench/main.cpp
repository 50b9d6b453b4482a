// Registers the benchmarks of the solver and hands over to Google Benchmark's command line.
#include <benchmark/benchmark.h>

#include "tests/bench/bench.h"

int main(int argc, char** argv) {
  reflines::bench::register_solves();
  reflines::bench::register_strategies();
  reflines::bench::register_biharmonic();
  reflines::bench::register_cages();
  reflines::bench::register_bounded();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
