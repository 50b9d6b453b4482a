#include "restoration/control_range.h"

#include <algorithm>
#include <cmath>

#include "restoration/press_rules.h"
#include "solver/limited_move.h"

namespace reflines {
namespace {

// Keeps a move, in units of the limit, within it by a function that is C^2, since an edge in the moves would be seen in
// the lines. Moves of twice the limit less where it begins, and more, are the limit itself.
double saturate_fraction(double move) {
  constexpr double kBegin = kRules.verdict.saturating;
  const double size = std::abs(move), t = std::clamp((size - kBegin) / (2 * (1 - kBegin)), 0.0, 1.0);
  if (t == 0) return move;
  return std::copysign(kBegin + 2 * (1 - kBegin) * t * (1 - t * t * (1 - 0.5 * t)), move);
}

}  // namespace

ControlRange::ControlRange(double limit, const MoveLimit& fraction, Eigen::Index control_count)
    : limits_(MoveLimit::within(limit, static_cast<int>(control_count))) {
  if (fraction.exists()) limits_ = {limit * fraction.lowest, limit * fraction.highest};
}

// Returns how far a control vertex may go in the direction of a move.
double ControlRange::end_towards(Eigen::Index control, double move) const {
  return move < 0 ? -limits_.lowest(control) : limits_.highest(control);
}

Mask ControlRange::find_beyond(const Vector& move) const {
  return move.array() > limits_.highest.array() || move.array() < limits_.lowest.array();
}

Vector ControlRange::cut(const Vector& move) const { return move.cwiseMax(limits_.lowest).cwiseMin(limits_.highest); }

Vector ControlRange::saturate(const Vector& move) const {
  Vector result = move;
  for (Eigen::Index c = 0; c < move.size(); ++c) {
    const double end = end_towards(c, move(c));
    result(c) = end > 0 ? end * saturate_fraction(move(c) / end) : 0;
  }
  return result;
}

double ControlRange::fraction_within(const Vector& move) const {
  double fraction = 1;
  for (Eigen::Index c = 0; c < move.size(); ++c) {
    if (move(c) != 0) fraction = std::min(fraction, end_towards(c, move(c)) / std::abs(move(c)));
  }
  return fraction;
}

Positions ControlRange::apply(const Positions& C, const Vector3& view, const Vector& move) const {
  Positions result = C;
  for (Eigen::Index c = 0; c < move.size(); ++c) {
    if (move(c) != 0) result.row(c) = move_point(C.row(c), move(c), view, {limits_.lowest(c), limits_.highest(c)});
  }
  return result;
}

}  // namespace reflines
