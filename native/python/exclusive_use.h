// Exclusive use of an optimizer by one thread. Optimizers cache what they compute, and work without the GIL: two
// threads in one optimizer overwrote each other's arrays (a segmentation fault within some ten solves). Waiting for the
// other thread could block Blender's window for the time of a solve, so the second call is refused.
#pragma once

#include <type_traits>
#include <utility>

#include "geometry/normal_fit.h"
#include "python/gil_handover.h"
#include "reflines/cage_optimizer.h"
#include "reflines/line_handles.h"
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
  ~ExclusiveUse();
  ExclusiveUse(const ExclusiveUse&) = delete;
  ExclusiveUse& operator=(const ExclusiveUse&) = delete;

 private:
  ExclusiveUse(const void* object, Use use, const char* name);

  const void* object_;
};

// The scope of a native call on an object, without the GIL. The object is released before the GIL is taken back, since
// a worker thread may have to wait for its turn.
template <typename Object>
class NativeCall {
 public:
  explicit NativeCall(const Object& object, ExclusiveUse::Use use = ExclusiveUse::Use::kChanges)
      : exclusive_use_(object, use) {}

 private:
  const ReleaseGil release_;
  const ExclusiveUse exclusive_use_;
};

// Wraps a method as such a call. The method returns a copy, since the object may change as soon as it is released.
template <typename Object, typename Result, typename... Arguments>
auto release_gil(Result (Object::*method)(Arguments...) const) {
  return [method](const Object& object, Arguments... arguments) -> std::remove_cvref_t<Result> {
    const NativeCall call(object, ExclusiveUse::Use::kReads);
    return (object.*method)(std::forward<Arguments>(arguments)...);
  };
}

template <typename Object, typename Result, typename... Arguments>
auto release_gil(Result (Object::*method)(Arguments...)) {
  return [method](Object& object, Arguments... arguments) -> std::remove_cvref_t<Result> {
    const NativeCall call(object);
    return (object.*method)(std::forward<Arguments>(arguments)...);
  };
}

}  // namespace reflines
