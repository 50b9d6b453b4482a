// Optimizers keep what they work out, and their work runs without Python's lock: two threads at work on one overwrote
// each other's arrays (a segmentation fault within some ten solves). Waiting for the other could block Blender's window
// for as long as a solve takes, so the second one is refused.
#pragma once

#include <type_traits>
#include <utility>

#include "native/bindings/turn.h"
#include "native/geometry/normals.h"
#include "native/shape_optimizer.h"

namespace reflines {

// An object taken for the time of a call. Several threads may read one, and one alone may change it; else InvalidInput,
// at once.
class InUse {
 public:
  enum class Use { kReads, kChanges };
  InUse(const ShapeOptimizer& optimizer, Use use) : InUse(&optimizer, use, "optimizer") {}
  InUse(const NormalFit& fit, Use use) : InUse(&fit, use, "normal fit") {}
  ~InUse();
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  InUse(const void* object, Use use, const char* name);

  const void* object_;
};

// Native work on it, without Python's lock. It is free again before the lock comes back: a worker may wait for its
// turn.
template <typename Object>
class At {
 public:
  explicit At(const Object& object, InUse::Use use = InUse::Use::kChanges) : in_use_(object, use) {}

 private:
  const ReleaseGil release_;
  const InUse in_use_;
};

// Methods as such calls; they return copies, since the object may change as soon as it is free.
template <typename Object, typename Result, typename... Arguments>
auto native(Result (Object::*method)(Arguments...) const) {
  return [method](const Object& object, Arguments... arguments) -> std::remove_cvref_t<Result> {
    const At at(object, InUse::Use::kReads);
    return (object.*method)(std::forward<Arguments>(arguments)...);
  };
}

template <typename Object, typename Result, typename... Arguments>
auto native(Result (Object::*method)(Arguments...)) {
  return [method](Object& object, Arguments... arguments) -> std::remove_cvref_t<Result> {
    const At at(object);
    return (object.*method)(std::forward<Arguments>(arguments)...);
  };
}

}  // namespace reflines
