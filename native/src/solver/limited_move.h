// Moves along the view that respect a limit exactly, in spite of rounding.
#pragma once

#include "reflines/move_limit.h"
#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput unless the limit has one range for each vertex, each containing 0.
void check(const MoveLimit& limit, int vertex_count);

// Returns whether the limit restricts no vertex.
bool is_infinite(const MoveLimit& limit);

struct MoveRange {
  double lowest, highest;
};

// Returns `height` (or the point p) moved along the view, rounded towards the start until the difference to it, as
// doubles, lies within the range, too.
double move_height(double height, double move, const MoveRange& range);
Eigen::RowVector3d move_point(const Eigen::RowVector3d& p, double move, const Vector3& view, const MoveRange& range);

}  // namespace reflines
