// The smoothest function on a part of a surface with given values at points: zero, with its slope, around the part.
#pragma once

#include <vector>

#include "geometry/triangle_locator.h"
#include "reflines/region_field.h"
#include "reflines/spd_factorize.h"
#include "reflines/types.h"

namespace reflines {

// Minimizes sum over vertices of A_v (Laplacian of c)^2 in the image plane, linear on triangles, with the Laplacian of
// cotangents. The factorization is that of the part: other points and values take one back substitution for each point.
class SmoothChange {
 public:
  // `part` (#V): the vertices where c need not be 0. `length` is the part's size: a factor of 1e-8 / length^4 of the
  // areas makes the system definite where the part has no edge, and leaves constants free there. `firmness` (#V) is
  // a further weight of c^2, in units of 1 / length^4: at 100 c falls to 0 within a third of the length.
  SmoothChange(const RegionField& field, const Mask& part, double length, const Vector& firmness,
               const SpdFactorize& factorize);

  const Mask& part() const { return part_; }

  // Returns c (#V) with the values (#at) at these places; 0 everywhere for values that are all 0. Where two places
  // contradict each other it is between them.
  Vector interpolate(const std::vector<Location>& at, const Vector& values) const;

 private:
  const RegionField& field_;
  Mask part_;
  std::vector<int> vertex_;  // of each unknown
  IndexVector unknown_;      // of each vertex, -1: none
  SpdSolve solve_;
};

}  // namespace reflines
