// Keeps the loops of libraries serial.
#pragma once

#include <omp.h>

namespace reflines {

// Makes CHOLMOD's own loops serial for a scope: they request four threads on any machine. On two cores they take as
// long as one thread, and each team of another size makes OpenMP end and start threads: some milliseconds. The setting
// belongs to the calling thread; before GCC 12 it belonged to the process, so that a thread of a team, whose loops are
// serial anyway, does not change it.
class SerialLoops {
 public:
  SerialLoops() : active_levels_(omp_get_max_active_levels()) { set(0); }
  ~SerialLoops() { set(active_levels_); }
  SerialLoops(const SerialLoops&) = delete;
  SerialLoops& operator=(const SerialLoops&) = delete;

 private:
  static void set(int active_levels) {
    if (!omp_in_parallel()) omp_set_max_active_levels(active_levels);
  }

  int active_levels_;
};

}  // namespace reflines
