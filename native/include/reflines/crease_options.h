// The rule by which edges of a region are creases: held, with no stencil that reaches across them.
#pragma once

#include "reflines/types.h"

namespace reflines {

// The bend of an edge (30 degrees) above which it is a crease, unless the surface is round there (see crease_edges).
constexpr double kCreaseAngle = 0.5235987755982988;

// The rule by which edges become creases.
enum class CreaseRule {
  kAutomatic,  // those found by their bend, and those marked
  kMarked,     // those marked
  kNone,
};

struct CreaseOptions {
  CreaseRule rule = CreaseRule::kAutomatic;
  double angle = kCreaseAngle;  // radians
  Edges marked = {};            // #M x 2, vertices in either order; what is no edge is ignored
};

}  // namespace reflines
