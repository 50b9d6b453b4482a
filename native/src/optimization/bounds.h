// The ends of ranges, the box low <= x <= high, and what is held at its ends.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

enum class Side : signed char { kLow = -1, kBetween = 0, kHigh = 1 };
using Sides = std::vector<Side>;  // n: the end of its range at which an unknown is held

// A limit that holds a function of the unknowns, or an unknown itself, at an end of its range.
struct Contact {
  int row;
  Side side;

  double sign() const { return side == Side::kLow ? 1.0 : -1.0; }  // of its force on the function
  bool operator==(const Contact&) const = default;
};
using Contacts = std::vector<Contact>;

struct Bounds {
  Vector low, high;  // n each, low <= high; infinite where there is none

  double end(int k, Side side) const { return side == Side::kLow ? low(k) : high(k); }
  bool is_point(int k) const { return low(k) == high(k); }

  Sides points() const;                  // the unknowns whose range is a point, at their lower end
  Vector ends(const Sides& held) const;  // 0 for those that are not held
  Vector nearest(const Vector& x) const { return x.cwiseMax(low).cwiseMin(high); }
  Vector nearest(const Vector& x, const Contacts& contacts) const;  // with these at their ends
  Sides touched_by(const Vector& x) const;  // x outside the bounds touches the end that it is beyond

  // Returns the norm of the projected gradient, which is 0 where the Karush-Kuhn-Tucker conditions hold at x: entries
  // of unknowns at an end of their range are left out where a descent would leave the range.
  double projected_norm(const Vector& x, const Vector& gradient) const;
};

double largest_finite(const Vector& values);  // by size; 0 where there is none
int count_held(const Sides& sides);
int count_changes(const Sides& before, const Sides& after);
void clear_held(const Sides& held, Vector& x);  // writes 0

}  // namespace reflines
