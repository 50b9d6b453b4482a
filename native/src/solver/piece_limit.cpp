// The bounds of a piece's unknowns that follow from the limit of its vertices.
#include <algorithm>
#include <limits>

#include "reflines/errors.h"
#include "solver/piece_problem.h"

namespace reflines {
namespace {

// Returns the unknown that is the height of a vertex up to a constant; -1 where there is none.
int unknown_of(const AffineMap& map, int v) {
  const int column = map.moving_index()[v];
  if (column < 0 || map.is_selection()) return column;
  const SparseMatrix::InnerIterator mode(map.moving_transposed(), column);
  return static_cast<int>(mode.row());
}

bool vertices_follow_one_unknown_each(const SparseMatrix& modes) {
  for (int column = 0; column < modes.cols(); ++column) {
    SparseMatrix::InnerIterator mode(modes, column);
    if (mode.value() != 1.0 || ++mode) return false;
  }
  return true;
}

}  // namespace

void PieceProblem::set_limit(const MoveLimit& limit) {
  if (limit.exists() && !vertices_follow_one_unknown_each(map_.moving_transposed())) {
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
    const int k = unknown_of(map_, v);
    if (k < 0) continue;
    bounds.low(k) = std::max(bounds.low(k), start(k) + limit_.lowest(v));
    bounds.high(k) = std::min(bounds.high(k), start(k) + limit_.highest(v));
  }
  return bounds;
}

double PieceProblem::move(int v) const {
  const double move = z_(v) - piece_.field.z(v);
  if (!limit_.exists()) return move;
  if (const int side = limited(v); side != 0) return side < 0 ? limit_.lowest(v) : limit_.highest(v);
  return std::clamp(move, limit_.lowest(v), limit_.highest(v));
}

int PieceProblem::limited(int v) const {
  if (!limit_.exists() || map_.moving_index()[v] < 0) return 0;
  if (z_(v) >= piece_.field.z(v) + limit_.highest(v)) return 1;
  return z_(v) <= piece_.field.z(v) + limit_.lowest(v) ? -1 : 0;
}

}  // namespace reflines
