#include "solver/limited_move.h"

#include <cmath>
#include <limits>
#include <string>

#include "reflines/errors.h"

namespace reflines {
namespace {

// The tolerance in the unit of length: a unit vector that is not along an axis has length 1 to a few roundings only,
// and a caller who normalizes the view again measures the move in slightly other units.
constexpr double kUnitRounding = 8 * std::numeric_limits<double>::epsilon();

bool is_range_around_zero(double lowest, double highest) { return lowest <= 0 && highest >= 0; }  // false for NaN

bool lies_within(const Eigen::RowVector3d& way, const Vector3& view, const MoveRange& range) {
  const double shrink = view.cwiseAbs().maxCoeff() == 1.0 ? 1.0 : 1.0 - kUnitRounding;
  const double move = way.dot(view);
  const double length = move < 0 ? -way.norm() : way.norm();
  return move <= range.highest * shrink && move >= range.lowest * shrink && length <= range.highest * shrink &&
         length >= range.lowest * shrink;
}

// The number of steps by the smallest difference that there is. Near zero those are so small that millions of millions
// of them are no move at all.
constexpr int kSmallSteps = 64;

// Returns a number nearer to `end` by a rounding of that.
double approach(double from, double end) {
  const double step = std::numeric_limits<double>::epsilon() * std::abs(end);
  return std::abs(end - from) <= step ? end : from + std::copysign(step, end - from);
}

}  // namespace

void check(const MoveLimit& limit, int vertex_count) {
  if (limit.lowest.size() != vertex_count || limit.highest.size() != vertex_count) {
    throw InvalidInput("The limit has " + std::to_string(limit.lowest.size()) + " lowest and " +
                       std::to_string(limit.highest.size()) + " highest moves; it needs one of each for each of the " +
                       std::to_string(vertex_count) + " vertices.");
  }
  int bad = 0;
  for (int v = 0; v < vertex_count; ++v) bad += !is_range_around_zero(limit.lowest(v), limit.highest(v));
  if (bad == 0) return;
  throw InvalidInput("The limit of " + std::to_string(bad) + " of the " + std::to_string(vertex_count) +
                     " vertices is negative, not a number, or its lowest move is above its highest; give a lowest move "
                     "of at most 0 and a highest of at least 0.");
}

bool is_infinite(const MoveLimit& limit) {
  return limit.lowest.array().isInf().all() && limit.highest.array().isInf().all();
}

double move_height(double height, double move, const MoveRange& range) {
  double moved = height + move;
  while (moved - height > range.highest || moved - height < range.lowest) moved = std::nextafter(moved, height);
  return moved;
}

Eigen::RowVector3d move_point(const Eigen::RowVector3d& p, double move, const Vector3& view, const MoveRange& range) {
  Eigen::RowVector3d moved = p + move * view.transpose();
  for (int step = 0; !lies_within(moved - p, view, range); ++step) {
    for (int i = 0; i < 3; ++i)
      moved(i) = step < kSmallSteps ? std::nextafter(moved(i), p(i)) : approach(moved(i), p(i));
  }
  return moved;
}

}  // namespace reflines
