// The two model problems of the paper's Figure 7: a bump made on a cylinder, and a bump taken away from it.
#pragma once

#include <memory>

#include "reflines/shape_optimizer.h"
#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines::bench {

// An irregular mesh over the unit square of the xy plane, seen from +z: the cylinder z = sqrt(1 - x^2) along y, with a
// smooth bump of radius 0.3 in its middle. The lines run along y and rise by 20 degrees.
class BumpCylinder {
 public:
  // cells x cells squares, each cut in two at random; inner vertices moved at random by up to 0.2 of a cell either way.
  explicit BumpCylinder(int cells);

  const PlanePositions& plane_positions() const { return xy_; }
  const Triangles& triangles() const { return F_; }
  Positions positions(double bump) const;  // with a bump `bump` times as high as the full one, 0.03
  Target target(double bump) const;        // its exact field, taken at the centroids

  // An optimizer over the surface with that bump, its border clamped.
  std::unique_ptr<ShapeOptimizer> optimizer(double bump) const;

 private:
  PlanePositions xy_;
  Triangles F_;
};

// Cells a side with (about) that many free vertices: a clamped border takes four rows off.
int cells_for_unknowns(int unknowns);

}  // namespace reflines::bench
