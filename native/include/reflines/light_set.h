// A set of lights for one press, each with the eye that sees it.
#pragma once

#include <vector>

#include "reflines/eyes.h"
#include "reflines/types.h"

namespace reflines {

struct LightSet {
  std::vector<Vector3> line_directions;  // of each light's lines; none: there is no set
  Eyes eyes;                             // of the lights
  // The weight of each light, 0 or more, or empty for 1 each, says how much its lines count where a limit or a cage
  // keeps a press from the shape without flaws. All are judged alike.
  std::vector<double> weight;

  bool exist() const { return !line_directions.empty(); }
};

}  // namespace reflines
