// A hand-over of Python's lock (GIL) between Blender's own thread and a worker thread.
//
// Blender lets go of Python's lock while its own C code runs, and asks whether *any* thread has the lock where it means
// "am I being called from Python" (PyC_IsInterpreterActive). With a second thread that takes the lock now and then the
// answer is wrong once in a while, and Blender then uses Python objects without the lock: a segmentation fault in about
// one of twenty window tests, within a second where a script runs operators with a context of its own. So a worker of
// ours runs Python only while Blender's thread waits for it, and native code, without the lock, at any time.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>

namespace reflines {

// The hand-over for one worker thread. `lend`, `take` and `rest` wait; they are called with Python's lock and let go of
// it meanwhile. The thread that has taken it keeps it alive: every native call of that thread asks it.
class PythonTurn : public std::enable_shared_from_this<PythonTurn> {
 public:
  // The owner: the worker may run Python until it rests, or until it comes to native code when `seconds` are over.
  // Returns within 5 s more where no thread has taken the turn yet.
  void lend(double seconds);
  // The owner: whether the worker waits for its turn, native code being done.
  bool wanted() const;
  // The owner, at the end: the worker may run Python whenever it wants, so that it can be joined.
  void give_away();

  // The worker's first call, from its own thread: from here on its native calls end in turns only.
  void take();
  // The worker has nothing to do before its next turn.
  void rest();
  // The worker's thread has ended.
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
  bool entered_ = false;   // since it was lent
  Clock::time_point end_;  // of what is lent
  bool given_away_ = false;
};

// In place of pybind11::gil_scoped_release: the lock comes back in the thread's turn only.
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
