// What rounding must not do to a vertex that touches its limit.
#pragma once

#include "reflines/move_limit.h"
#include "reflines/types.h"

namespace reflines {

// Throws InvalidInput where the limit has not one range a vertex, or some are no ranges around 0.
void check(const MoveLimit& limit, int vertex_count);

// True where it holds no vertex back.
bool is_infinite(const MoveLimit& limit);

struct MoveRange {
  double lowest, highest;
};

// `height` (or the point p) moved along the view, rounded towards where it came from until also the difference to it,
// as doubles, lies within the range.
double moved_height(double height, double move, const MoveRange& range);
Eigen::RowVector3d moved_point(const Eigen::RowVector3d& p, double move, const Vector3& view, const MoveRange& range);

}  // namespace reflines
