// Threads that run work in the background, one piece each.
#pragma once

#include <functional>

namespace reflines {

// Runs `work`, which must not throw, on a background thread. A thread that has ended its work is used again: OpenMP
// starts a team for each thread that comes to a parallel region first.
void run_in_background(std::function<void()> work);

// Waits until no work runs in the background.
void wait_for_background_work();

}  // namespace reflines
