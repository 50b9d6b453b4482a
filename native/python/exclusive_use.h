// Optimizers keep what they work out, and their work runs without Python's lock: two threads at work on one overwrote
// each other's arrays (a segmentation fault within some ten solves). Waiting for the other could block Blender's window
// for as long as a solve takes, so the second one is refused.
#pragma once

#include <type_traits>
#include <utility>

#include "geometry/normal_fit.h"
#include "python/gil_handover.h"
#include "reflines/shape_optimizer.h"

namespace reflines {

// An object taken for the time of a call. Several threads may read one, and one alone may change it; else InvalidInput,
// at once.
class ExclusiveUse {
 public:
  enum class Use { kReads, kChanges };
  ExclusiveUse(const ShapeOptimizer& optimizer, Use use) : ExclusiveUse(&optimizer, use, "optimizer") {}
  ExclusiveUse(const NormalFit& fit, Use use) : ExclusiveUse(&fit, use, "normal fit") {}
  ~ExclusiveUse();
  ExclusiveUse(const ExclusiveUse&) = delete;
  ExclusiveUse& operator=(const ExclusiveUse&) = delete;

 private:
  ExclusiveUse(const void* object, Use use, const char* name);

  const void* object_;
};

// Native work on it, without Python's lock. It is free again before the lock comes back: a worker may wait for its
// turn.
template <typename Object>
class NativeCall {
 public:
  explicit NativeCall(const Object& object, ExclusiveUse::Use use = ExclusiveUse::Use::kChanges)
      : exclusive_use_(object, use) {}

 private:
  const ReleaseGil release_;
  const ExclusiveUse exclusive_use_;
};

// Methods as such calls; they return copies, since the object may change as soon as it is free.
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
