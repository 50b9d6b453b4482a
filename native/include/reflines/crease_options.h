// The rule by which edges of a region are creases: held, with no stencil that reaches across them.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Edges that bend by more than this (30 degrees) are creases unless the surface is round there (see crease_edges).
constexpr double kCreaseAngle = 0.5235987755982988;

// Which edges are creases.
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
