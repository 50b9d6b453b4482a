// The eyes that see families of light lines, where these are not all seen along the view of a solve.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

struct Eyes {
  std::vector<Vector3> directions;  // of each family, from the surface to its eye; or none: all along the view
  // These surfaces, #B x 3 each, or none, may hide the region from an eye, as its own triangles may.
  Positions blocker_vertices;
  Triangles blockers;
  // The frame's y axis follows this light line where it is one; 0: the first of the families that is not parallel to
  // the view. What rounding and thresholds make of a surface is then the same for all sets of families.
  Vector3 frame_line = Vector3::Zero();

  bool exist() const { return !directions.empty(); }
};

}  // namespace reflines
