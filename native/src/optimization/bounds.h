// The box low <= x <= high in which a minimum is looked for, and where a point touches it.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

enum class Side : signed char { kLow = -1, kBetween = 0, kHigh = 1 };
using Sides = std::vector<Side>;  // n: at which end of its range an unknown is held

struct Bounds {
  Vector low, high;  // n each, low <= high; infinite where there is none

  bool exist() const { return low.size() > 0; }
  double end(int k, Side side) const { return side == Side::kLow ? low(k) : high(k); }
  bool is_point(int k) const { return low(k) == high(k); }

  Vector ends(const Sides& held) const;  // 0 for those that are not held
  Vector nearest(const Vector& x) const { return x.cwiseMax(low).cwiseMin(high); }
  Sides touched_by(const Vector& x) const;  // x outside touches the end it is beyond
  Bounds seen_from(const Vector& x) const;  // of the step d from x: low <= x + d <= high

  // The Karush-Kuhn-Tucker conditions hold at x where this is 0: the norm of the gradient without the entries of
  // unknowns at an end of their range that are pressed against it.
  double projected_norm(const Vector& x, const Vector& gradient) const;
};

int count_held(const Sides& sides);
int count_changes(const Sides& before, const Sides& after);

}  // namespace reflines
