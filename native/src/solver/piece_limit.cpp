// The bounds of a piece's unknowns that follow from the limit of its vertices.
#include <algorithm>
#include <limits>

#include "reflines/errors.h"
#include "solver/piece_problem.h"

namespace reflines {

void PieceProblem::set_limit(const MoveLimit& limit) {
  if (limit.exists() && !is_mesh()) {
    throw InvalidInput(
        "A limit of the move holds the vertices of a mesh, not yet the surface of a cage; solve without one, or apply "
        "the Subdivision Surface first.");
  }
  limit_ = MoveLimit::none();
  if (!limit.exists()) return;
  limit_.lowest = limit.lowest(piece_.vertex);
  limit_.highest = limit.highest(piece_.vertex);
}

Bounds PieceProblem::bounds() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{Vector::Constant(size(), -kInfinity), Vector::Constant(size(), kInfinity)};
  const Vector& start = map_.start();
  for (int v = 0; v < piece_.field.vertex_count(); ++v) {
    const int k = map_.moving_index()[v];
    if (k < 0) continue;
    bounds.low(k) = std::max(bounds.low(k), start(k) + limit_.lowest(v));
    bounds.high(k) = std::min(bounds.high(k), start(k) + limit_.highest(v));
  }
  return bounds;
}

double PieceProblem::move(int v) const {
  const int k = map_.moving_index()[v];
  if (k < 0) return 0;
  // A mesh's vertex moves as its unknown does, which mirror images share to the last bit.
  const double move = map_.is_selection() ? x_(k) - map_.start()(k) : z_(v) - piece_.field.z(v);
  if (!limit_.exists()) return move;
  if (const int side = limited(v); side != 0) return side < 0 ? limit_.lowest(v) : limit_.highest(v);
  return std::clamp(move, limit_.lowest(v), limit_.highest(v));
}

int PieceProblem::limited(int v) const {
  const int k = map_.moving_index()[v];
  if (!limit_.exists() || k < 0) return 0;
  if (x_(k) >= map_.start()(k) + limit_.highest(v)) return 1;
  return x_(k) <= map_.start()(k) + limit_.lowest(v) ? -1 : 0;
}

}  // namespace reflines
