#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>

#include "python/bind.h"
#include "python/native_call.h"
#include "reflines/errors.h"
#include "threads/work_threads.h"

namespace py = pybind11;

namespace reflines {
namespace {

// The state that a task and its thread both use.
struct Outcome {
  std::mutex mutex;
  std::condition_variable changed;
  bool done = false;
  std::exception_ptr error;
};

void finish(Outcome& outcome, std::exception_ptr error) {
  const std::scoped_lock lock(outcome.mutex);
  outcome.error = std::move(error);
  outcome.done = true;
  outcome.changed.notify_all();
}

// Refuses functions written in Python: objects that these alone refer to may be deleted while native work uses them.
void check_is_native(const py::function& function) {
  PyObject* called = function.ptr();
  if (PyMethod_Check(called)) called = PyMethod_GET_FUNCTION(called);
  if (PyInstanceMethod_Check(called)) called = PyInstanceMethod_GET_FUNCTION(called);
  if (PyCFunction_Check(called)) return;
  throw InvalidInput(
      "start takes a function or a method of this module, and its arguments apart: start(solver.solve, "
      "target), not start(lambda: solver.solve(target)).");
}

// The call that the `start` of this thread waits for; null outside of it.
thread_local std::optional<NativeCall>* deferred = nullptr;

// Calls a function of the module up to its native work; empty where it has none.
class DeferScope {
 public:
  DeferScope() : outer_(std::exchange(deferred, &call_)) {}
  ~DeferScope() { deferred = outer_; }
  DeferScope(const DeferScope&) = delete;
  DeferScope& operator=(const DeferScope&) = delete;

  std::optional<NativeCall> take() { return std::exchange(call_, std::nullopt); }

 private:
  std::optional<NativeCall> call_;
  std::optional<NativeCall>* outer_;
};

// A native call in the background; errors come with its result, also those of its arguments. It holds the arguments,
// which the work refers to, until that has ended.
class Task {
 public:
  Task(const py::function& function, const py::args& arguments, const py::kwargs& named)
      : arguments_(py::make_tuple(function, arguments, named)), outcome_(std::make_shared<Outcome>()) {
    try {
      DeferScope scope;
      value_ = function(*arguments, **named);
      if (std::optional<NativeCall> call = scope.take()) {
        begin(std::move(*call));
        return;
      }
      finish(*outcome_, nullptr);
    } catch (py::error_already_set& error) {  // can be thrown once only
      raised_ = error.value();
      finish(*outcome_, nullptr);
    } catch (...) {
      finish(*outcome_, std::current_exception());
    }
  }
  ~Task() { wait_for(std::nullopt); }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  bool done() const {
    const std::scoped_lock lock(outcome_->mutex);
    return outcome_->done;
  }

  bool wait(double seconds) {
    if (!(seconds >= 0)) throw InvalidInput("The time to wait must be 0 or more seconds.");
    return wait_for(seconds);
  }

  py::object result() {
    wait_for(std::nullopt);
    if (raised_) {
      PyErr_SetObject(py::type::of(raised_).ptr(), raised_.ptr());
      throw py::error_already_set();
    }
    if (outcome_->error) std::rethrow_exception(outcome_->error);
    if (convert_) value_ = std::exchange(convert_, nullptr)();
    return value_;
  }

 private:
  void begin(NativeCall call) {
    convert_ = std::move(call.convert);
    run_in_background([work = std::move(call.work), outcome = outcome_]() mutable {
      std::exception_ptr error;
      try {
        work();
      } catch (...) {
        error = std::current_exception();
      }
      work = nullptr;
      finish(*outcome, std::move(error));
    });
  }

  bool wait_for(std::optional<double> seconds) {
    const auto is_done = [this] { return outcome_->done; };
    const ReleaseGil release;
    std::unique_lock<std::mutex> lock(outcome_->mutex);
    if (!seconds) {
      outcome_->changed.wait(lock, is_done);
      return true;
    }
    constexpr double kLongest = 1e6;  // seconds; chrono overflows with more
    return outcome_->changed.wait_for(lock, std::chrono::duration<double>(std::min(*seconds, kLongest)), is_done);
  }

  py::tuple arguments_;
  std::shared_ptr<Outcome> outcome_;
  std::function<py::object()> convert_;
  py::object value_ = py::none();
  py::object raised_;  // by the conversion of the arguments
};

void wait_at_exit() {
  const ReleaseGil release;
  wait_for_background_work();
}

}  // namespace

void check_single_call() {
  if (deferred != nullptr && *deferred) {
    throw InvalidInput("A task is one native call: start each of several by itself.");
  }
}

py::object run_or_defer(NativeCall call) {
  check_single_call();
  if (deferred != nullptr) {
    *deferred = std::move(call);
    return py::none();
  }
  {
    const ReleaseGil release;
    call.work();
    call.work = nullptr;  // ends its exclusive use
  }
  return call.convert();
}

void bind_task(py::module_& module) {
  py::class_<Task>(module, "Task", py::module_local())
      .def_property_readonly("done", &Task::done)
      .def("wait", &Task::wait, py::arg("seconds"))
      .def("result", &Task::result);
  module.def("start", [](const py::function& function, const py::args& arguments, const py::kwargs& named) {
    check_is_native(function);
    return std::make_unique<Task>(function, arguments, named);
  });
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_at_exit));
}

}  // namespace reflines
