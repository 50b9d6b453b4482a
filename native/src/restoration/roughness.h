// The roughness of heights: what quadratic surfaces do not explain of them.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// The distance of each height from a quadratic least-squares fit of the vertices within two edges: an operator that
// vanishes for quadratic surfaces on any mesh. The umbrella operator, applied twice, does not: where the diagonals of
// quads change sides, a dent of 4 mm was less rough than the clean surface beside it, and its mirror image got a
// quarter of it.
class Roughness {
 public:
  // Keeps a reference to the places xy (#V x 2).
  Roughness(const PlanePositions& xy, const Triangles& F);

  Vector of(const Vector& z) const;  // #V of heights (#V)

 private:
  std::vector<int> two_rings(int v) const;
  double at(int v, const Vector& z) const;

  const PlanePositions& xy_;
  std::vector<std::vector<int>> neighbors_;
};

}  // namespace reflines
