#include "python/gil_handover.h"

#include "python/bind.h"

namespace py = pybind11;

namespace reflines {
namespace {

// The hand-over of the current worker thread; when the thread ends, the owner need not wait for it any more.
struct OwnTurn {
  ~OwnTurn() {
    if (turn != nullptr) turn->end();
  }
  std::shared_ptr<PythonTurn> turn;
};
thread_local OwnTurn own;

constexpr std::chrono::seconds kStart{5};  // time limit for a started thread to take its first turn, on a busy machine

// The owner's handle in Python. Its collection ends the hand-over: nobody can lend any more, and the worker's next call
// would wait for ever.
class OwnersTurn {
 public:
  OwnersTurn() : turn_(std::make_shared<PythonTurn>()) {}
  ~OwnersTurn() { turn_->give_away(); }
  OwnersTurn(const OwnersTurn&) = delete;
  OwnersTurn& operator=(const OwnersTurn&) = delete;

  void lend(double seconds) { turn_->lend(seconds); }
  bool wanted() const { return turn_->wanted(); }
  void give_away() { turn_->give_away(); }
  void take() { turn_->take(); }
  void rest() { turn_->rest(); }

 private:
  std::shared_ptr<PythonTurn> turn_;
};

}  // namespace

void PythonTurn::lend(double seconds) {
  const py::gil_scoped_release release;
  std::unique_lock<std::mutex> lock(mutex_);
  end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  if (worker_ == Worker::kResting) worker_ = Worker::kWaiting;
  lent_ = true;
  entered_ = false;
  changed_.notify_all();
  if (!changed_.wait_until(lock, end_ + kStart, [this] { return taken_ || given_away_; })) ended_ = true;
  while (!ended_ && worker_ != Worker::kResting) {
    if (worker_ == Worker::kPython || (worker_ == Worker::kWaiting && !entered_)) {
      changed_.wait(lock);
    } else if (Clock::now() < end_) {
      changed_.wait_until(lock, end_);
    } else {
      break;
    }
  }
  lent_ = false;
}

bool PythonTurn::wanted() const {
  const std::scoped_lock lock(mutex_);
  return worker_ == Worker::kWaiting;
}

void PythonTurn::give_away() {
  const std::scoped_lock lock(mutex_);
  given_away_ = true;
  if (worker_ == Worker::kResting) worker_ = Worker::kWaiting;
  changed_.notify_all();
}

void PythonTurn::take() {
  own.turn = shared_from_this();
  const py::gil_scoped_release release;
  {
    const std::scoped_lock lock(mutex_);
    taken_ = true;
    ended_ = false;  // one that came late
  }
  enter();
}

void PythonTurn::rest() {
  const py::gil_scoped_release release;
  std::unique_lock<std::mutex> lock(mutex_);
  worker_ = given_away_ ? Worker::kWaiting : Worker::kResting;
  changed_.notify_all();
  wait_for_turn(lock);
}

void PythonTurn::end() {
  const std::scoped_lock lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void PythonTurn::leave(Worker to) {
  const std::scoped_lock lock(mutex_);
  worker_ = to;
  changed_.notify_all();
}

void PythonTurn::enter() {
  std::unique_lock<std::mutex> lock(mutex_);
  worker_ = Worker::kWaiting;
  changed_.notify_all();
  wait_for_turn(lock);
}

void PythonTurn::wait_for_turn(std::unique_lock<std::mutex>& lock) {
  changed_.wait(lock, [this] { return worker_ == Worker::kWaiting && may_enter(); });
  worker_ = Worker::kPython;
  entered_ = true;
  changed_.notify_all();
}

ReleaseGil::ReleaseGil() : state_(PyEval_SaveThread()) {
  if (own.turn != nullptr) own.turn->leave(PythonTurn::Worker::kNative);
}

ReleaseGil::~ReleaseGil() {
  if (own.turn != nullptr) own.turn->enter();
  PyEval_RestoreThread(state_);
}

void bind_turn(py::module_& module) {
  py::class_<OwnersTurn>(module, "PythonTurn", py::module_local())
      .def(py::init<>())
      .def("lend", &OwnersTurn::lend, py::arg("seconds"))
      .def_property_readonly("wanted", &OwnersTurn::wanted)
      .def("give_away", &OwnersTurn::give_away)
      .def("take", &OwnersTurn::take)
      .def("rest", &OwnersTurn::rest);
}

}  // namespace reflines
