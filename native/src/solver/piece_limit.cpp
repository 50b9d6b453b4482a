// The limits of a piece's unknowns that follow from the limit of its vertices.
#include <algorithm>
#include <limits>

#include "solver/piece_problem.h"

namespace reflines {
namespace {

// The distance of a vertex that touches its limit from it, relative to the size of the limits: a thousand tolerances of
// RowLimits.
constexpr double kTouching = 1e-5;

}  // namespace

void PieceProblem::set_limit(const MoveLimit& limit, double rounding) {
  limit_ = MoveLimit::none();
  limit_rounding_ = rounding;
  if (!limit.exists()) return;
  limit_.lowest = limit.lowest(piece_.vertex);
  limit_.highest = limit.highest(piece_.vertex);
  limit_size_ = std::max(largest_finite(limit_.lowest), largest_finite(limit_.highest));
}

RowLimits PieceProblem::limits() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int count = map_.moving_count();
  Bounds range{Vector::Constant(count, -kInfinity), Vector::Constant(count, kInfinity)};
  for (int v = 0; v < piece_.field.vertex_count(); ++v) {
    const int k = map_.moving_index()[v];
    if (k < 0) continue;
    const double start = is_mesh() ? map_.start()(k) : 0.0;  // bounds are absolute
    range.low(k) = std::max(range.low(k), start + limit_.lowest(v));
    range.high(k) = std::min(range.high(k), start + limit_.highest(v));
  }
  return is_mesh() ? RowLimits(range)
                   : RowLimits(map_.moving_transposed(), range.low, range.high, map_.start(), limit_rounding_);
}

double PieceProblem::move(int v) const {
  const int k = map_.moving_index()[v];
  if (k < 0) return 0;
  // A mesh's vertex moves as its unknown does, which is that of its mirror image to the last bit.
  const double move = map_.is_selection() ? x_(k) - map_.start()(k) : z_(v) - piece_.field.z(v);
  if (!limit_.exists()) return move;
  if (const int side = is_mesh() ? limited(v) : 0; side != 0) return side < 0 ? limit_.lowest(v) : limit_.highest(v);
  return std::clamp(move, limit_.lowest(v), limit_.highest(v));
}

// Returns the distance from an end of its range at which a vertex of a cage's surface touches it: a fraction of the
// largest limit, or of the largest move where all are infinite or 0.
double PieceProblem::touching_distance(int v) const {
  const double size = limit_size_ > 0 ? limit_size_ : largest_move_;
  return kTouching * size * map_.moving_transposed().col(map_.moving_index()[v]).sum();
}

int PieceProblem::limited(int v) const {
  const int k = map_.moving_index()[v];
  if (!limit_.exists() || k < 0) return 0;
  if (!is_mesh()) {
    const double move = z_(v) - piece_.field.z(v), near = touching_distance(v);
    if (move >= limit_.highest(v) - near) return 1;
    return move <= limit_.lowest(v) + near ? -1 : 0;
  }
  if (x_(k) >= map_.start()(k) + limit_.highest(v)) return 1;
  return x_(k) <= map_.start()(k) + limit_.lowest(v) ? -1 : 0;
}

}  // namespace reflines
