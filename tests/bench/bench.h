// What each file of benchmarks offers to main.
#pragma once

namespace reflines::bench {

void register_solves();
void register_strategies();
void register_biharmonic();
void register_cages();
void register_bounded();

}  // namespace reflines::bench
