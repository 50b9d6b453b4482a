// Reads the eyes of families of light lines from Python.
#pragma once

#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "python/array_arguments.h"
#include "python/index_arrays.h"
#include "python/line_directions.h"
#include "reflines/eyes.h"

namespace reflines {

using EyeDirections = std::optional<Eigen::MatrixXd>;           // 3, or #families x 3
using Blockers = std::optional<std::pair<Positions, Indices>>;  // V, F

inline Eyes eyes_of(const EyeDirections& directions, const Blockers& blockers) {
  Eyes eyes;
  if (directions) eyes.directions = read_directions(*directions, "An eye direction");
  if (blockers) {
    eyes.blocker_vertices = blockers->first;
    eyes.blockers = triangles_of(blockers->second);
  }
  return eyes;
}

}  // namespace reflines
