// Calls of native code from Python: without the global interpreter lock (GIL), at once or in the background.
//
// Blender releases the GIL while its own C code runs, and tests whether *any* thread holds it where it means "am I
// being called from Python" (PyC_IsInterpreterActive). With a second thread that takes the GIL from time to time the
// test is sometimes wrong, and Blender then uses Python objects without the GIL: a segmentation fault in about one of
// twenty window tests, within a second where a script runs operators with a context of its own. Therefore background
// threads run native work alone and never take the GIL: arguments are converted before, and results after it, by the
// thread that calls.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace reflines {

using ReleaseGil = pybind11::gil_scoped_release;

// The two halves of a call: `work` runs without the GIL, and then `convert` returns the result with it.
struct NativeCall {
  std::function<void()> work;
  std::function<pybind11::object()> convert;
};

// Refuses a second call within one `reflines.start`.
void check_single_call();

// Runs a call now. Within `reflines.start`, leaves it to that and returns None.
pybind11::object run_or_defer(NativeCall call);

// Runs `work` without the GIL and converts its result by `convert`; under `reflines.start` in the background, later.
// So `work` must own what it reads, but for the objects that Python passed by reference, which live as long as the
// call.
template <typename Work, typename Convert>
pybind11::object run_native(Work work, Convert convert) {
  using Result = std::invoke_result_t<Work&>;
  const auto result = std::make_shared<std::optional<Result>>();
  return run_or_defer({[work = std::make_shared<Work>(std::move(work)), result] { result->emplace((*work)()); },
                       [result, convert = std::move(convert)] { return convert(std::move(**result)); }});
}

template <typename Work>
pybind11::object run_native(Work work) {
  using Result = std::invoke_result_t<Work&>;
  if constexpr (std::is_void_v<Result>) {
    return run_or_defer({std::move(work), [] { return pybind11::none(); }});
  } else {
    return run_native(std::move(work), [](Result result) { return pybind11::cast(std::move(result)); });
  }
}

// Makes a constructor of Python, and a function that `reflines.start` takes, from `prepare`, which converts the
// arguments and returns the work that builds the object.
template <typename Built, typename... Arguments>
auto construct(std::function<std::unique_ptr<Built>()> (*prepare)(Arguments...)) {
  return [prepare](Arguments... arguments) {
    const auto build = prepare(std::forward<Arguments>(arguments)...);
    const ReleaseGil release;
    return build();
  };
}

template <typename Built, typename... Arguments>
auto create(std::function<std::unique_ptr<Built>()> (*prepare)(Arguments...)) {
  return [prepare](Arguments... arguments) { return run_native(prepare(std::forward<Arguments>(arguments)...)); };
}

}  // namespace reflines
