// The seams of a region: the edges along which a panel is compared with what lies on their other side.
#pragma once

#include <vector>

#include "reflines/check_panel.h"
#include "reflines/types.h"

namespace reflines {

struct Seam {
  int first, second;  // vertices
  int own, other;     // triangles on both sides, the own one in the region; -1: none
  SeamKind kind;
  bool is_joined;  // both triangles have the edge
};

struct Seams {
  std::vector<Seam> list;
  Triangles
      neighbors;  // #F x 3: the triangle across the edge opposite each corner, -1 across a seam and where there is none
};

// Finds the seams of the surface before, see check_panel.
Seams find_seams(const Positions& before, const Triangles& F, const Mask& region, const CheckOptions& options);

}  // namespace reflines
