// Exclusive use of an optimizer by one thread. Optimizers cache what they compute, and work without the GIL: two
// threads in one optimizer overwrote each other's arrays (a segmentation fault within some ten solves). Waiting for the
// other thread could block Blender's window for the time of a solve, so the second call is refused.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "geometry/normal_fit.h"
#include "python/native_call.h"
#include "reflines/cage_optimizer.h"
#include "reflines/handle_follower.h"
#include "reflines/joint_smoother.h"
#include "reflines/line_handles.h"
#include "reflines/panel_smoother.h"
#include "reflines/shape_optimizer.h"

namespace reflines {

// Reserves an object for the time of a call. Several threads may read it, or one may change it; otherwise the
// constructor throws InvalidInput at once.
class ExclusiveUse {
 public:
  enum class Use { kReads, kChanges };
  ExclusiveUse(const ShapeOptimizer& optimizer, Use use) : ExclusiveUse(&optimizer, use, "optimizer") {}
  ExclusiveUse(const CageOptimizer& optimizer, Use use) : ExclusiveUse(optimizer.surface(), use) {}
  ExclusiveUse(const NormalFit& fit, Use use) : ExclusiveUse(&fit, use, "normal fit") {}
  ExclusiveUse(const LineHandles& handles, Use use) : ExclusiveUse(&handles, use, "set of handles") {}
  ExclusiveUse(const HandleFollower& follower, Use use) : ExclusiveUse(&follower, use, "follower") {}
  ExclusiveUse(const PanelSmoother& smoother, Use use) : ExclusiveUse(&smoother, use, "panel smoother") {}
  ExclusiveUse(const JointSmoother& smoother, Use use) : ExclusiveUse(&smoother, use, "smoother of panels") {}
  ~ExclusiveUse();
  ExclusiveUse(const ExclusiveUse&) = delete;
  ExclusiveUse& operator=(const ExclusiveUse&) = delete;

 private:
  ExclusiveUse(const void* object, Use use, const char* name);

  const void* object_;
};

// Calls `work` on an object that is used by nobody else meanwhile; see run_native. The object is reserved at once, not
// by the thread in the background, so that of two calls the one that was started later is refused, whichever runs
// first.
template <typename Object, typename Work>
pybind11::object call_native(Object& object, ExclusiveUse::Use use, Work work) {
  check_single_call();
  return run_native(
      [exclusive_use = std::make_shared<const ExclusiveUse>(object, use), work = std::move(work)] { return work(); });
}

template <typename Object, typename Work>
pybind11::object call_native(Object& object, Work work) {
  return call_native(object, ExclusiveUse::Use::kChanges, std::move(work));
}

// Wraps a method as such a call. Arguments and result are copies, since the object may change as soon as it is
// released.
template <typename Object, typename Result, typename... Arguments>
auto bind_method(Result (Object::*method)(Arguments...) const) {
  return [method](const Object& object, std::remove_cvref_t<Arguments>... arguments) {
    return call_native(object, ExclusiveUse::Use::kReads,
                       [method, &object, ... own = std::move(arguments)]() -> std::remove_cvref_t<Result> {
                         return (object.*method)(own...);
                       });
  };
}

template <typename Object, typename Result, typename... Arguments>
auto bind_method(Result (Object::*method)(Arguments...)) {
  return [method](Object& object, std::remove_cvref_t<Arguments>... arguments) {
    return call_native(object, [method, &object, ... own = std::move(arguments)]() -> std::remove_cvref_t<Result> {
      return (object.*method)(own...);
    });
  };
}

}  // namespace reflines
