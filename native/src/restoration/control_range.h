// The range within which each control vertex may move along the view.
#pragma once

#include <limits>

#include "reflines/move_limit.h"
#include "reflines/types.h"

namespace reflines {

// The largest limit, which stands for an infinite one, since a vertex with a fraction of 0 stays: infinity times 0 is
// no number.
inline constexpr double kNoLimit = std::numeric_limits<double>::max();

class ControlRange {
 public:
  // `limit` is a length up to kNoLimit; `fraction` holds each control vertex's fractions of it (#C), or none: -1 and 1.
  ControlRange(double limit, const MoveLimit& fraction, Eigen::Index control_count);

  const MoveLimit& limits() const { return limits_; }  // #C, lengths

  Mask find_beyond(const Vector& move) const;  // #C: those that a move (#C) takes out of their range
  Vector cut(const Vector& move) const;        // each vertex's move at the end of its range at most

  // Returns a move each of whose parts saturates at the end of its range, without an edge.
  Vector saturate(const Vector& move) const;

  // Returns the largest fraction of a move that lies within the range everywhere.
  double fraction_within(const Vector& move) const;

  // Returns the control vertices C (#C x 3) after a move (#C) along `view`, rounded so that none is beyond its range by
  // a bit; those that do not move keep their bits.
  Positions apply(const Positions& C, const Vector3& view, const Vector& move) const;

 private:
  double end_towards(Eigen::Index control, double move) const;

  MoveLimit limits_;
};

}  // namespace reflines
