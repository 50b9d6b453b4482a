// A hand-over of Python's global interpreter lock (GIL) between Blender's main thread and a worker thread.
//
// Blender releases the GIL while its own C code runs, and tests whether *any* thread holds it where it means "am I
// being called from Python" (PyC_IsInterpreterActive). With a second thread that takes the GIL from time to time the
// test is sometimes wrong, and Blender then uses Python objects without the GIL: a segmentation fault in about one of
// twenty window tests, within a second where a script runs operators with a context of its own. Therefore a worker
// thread runs Python only while Blender's thread waits for it, and native code, without the GIL, at any time.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>

namespace reflines {

// The hand-over for one worker thread. `lend`, `take` and `rest` are called with the GIL, release it and wait. The
// thread that has taken the hand-over keeps it alive: every native call of that thread uses it.
class PythonTurn : public std::enable_shared_from_this<PythonTurn> {
 public:
  // Lets the worker run Python until it rests, or until it enters native code after `seconds`; for the owner. Returns
  // within a further 5 s where no thread has taken the turn yet.
  void lend(double seconds);
  // Returns whether the worker has finished its native code and waits for its turn; for the owner.
  bool wanted() const;
  // Lets the worker run Python at any time, so that it can be joined; for the owner, at the end.
  void give_away();

  // Waits for the first turn; for the worker, from its own thread. From here on its native calls return only in its
  // turns.
  void take();
  // Ends a turn and waits for the next; for the worker when it has nothing to do.
  void rest();
  // Marks the worker's thread as ended.
  void end();

 private:
  friend class ReleaseGil;
  enum class Worker { kResting, kNative, kWaiting, kPython };
  using Clock = std::chrono::steady_clock;

  void leave(Worker to);
  void enter();
  void wait_for_turn(std::unique_lock<std::mutex>& lock);
  bool may_enter() const { return given_away_ || (lent_ && (!entered_ || Clock::now() < end_)); }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Worker worker_ = Worker::kWaiting;
  bool taken_ = false, ended_ = false;
  bool lent_ = false;
  bool entered_ = false;   // the worker has run since the turn was lent
  Clock::time_point end_;  // end of the turn that is lent
  bool given_away_ = false;
};

// Releases the GIL for a scope, in place of pybind11::gil_scoped_release: a worker thread takes it back only in its
// turn.
class ReleaseGil {
 public:
  ReleaseGil();
  ~ReleaseGil();
  ReleaseGil(const ReleaseGil&) = delete;
  ReleaseGil& operator=(const ReleaseGil&) = delete;

 private:
  PyThreadState* state_;
};

}  // namespace reflines
