// Reads the surroundings of a region from Python: (V, F), or None.
#pragma once

#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "python/array_arguments.h"
#include "python/index_arrays.h"
#include "reflines/surroundings.h"

namespace reflines {

using Around = std::optional<std::pair<Positions, Indices>>;

inline Surroundings surroundings_of(const Around& around) {
  if (!around) return {};
  return {around->first, triangles_of(around->second)};
}

}  // namespace reflines
