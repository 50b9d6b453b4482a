// Runs long work so that a cancelled caller need not wait for its end.
#pragma once

#include <functional>

#include "reflines/progress.h"

namespace reflines {

// Returns whether run_abandonable would give work to a thread of its own: there is someone who may cancel it, and the
// caller is no such thread itself.
bool may_abandon(const Progress* progress);

// Runs `work` and returns at its end, or rethrows what it throws. Where it may be abandoned, it runs on a thread of its
// own, and Cancelled is thrown some milliseconds after Progress::cancel, whatever `work` does: libraries that factor
// and subdivide cannot be interrupted. Therefore `work` must own all that it reads and writes: it may go on after the
// call. Abandoned work ends by itself; the next call waits for that, so that no more than one of them takes memory and
// time, and so does the end of the process.
void run_abandonable(const Progress* progress, std::function<void()> work);

}  // namespace reflines
