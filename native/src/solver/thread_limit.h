// The number of OpenMP threads, limited for a scope.
#pragma once

#include <omp.h>

namespace reflines {

// Limits the threads of a scope. Solves for a drag take 10 to 20 ms: on a machine that is busy with drawing, threads
// waiting for each other took five times as long as one thread alone. The bits are the same.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) : before_(omp_get_max_threads()) {  // 0: no limit
    if (threads > 0) omp_set_num_threads(threads);
  }
  ~ThreadLimit() { omp_set_num_threads(before_); }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int before_;
};

}  // namespace reflines
