// What the builders of targets see of a region: its triangles in the image plane and the lines it has now.
#pragma once

#include "native/types.h"

namespace reflines {

// Rows follow the region's triangles (#F) and vertices (#V). Image-plane coordinates are those of the world origin: the
// point V has the coordinates (V.x_axis, V.y_axis) of the optimizer's frame.
struct RegionField {
  PlanePositions xy;             // #V x 2
  Triangles F;                   // #F x 3
  Mask active;                   // #F: triangles of height-field pieces; the others are not read
  Vector area;                   // #F: projected; 0 where not active
  PlanePositions center;         // #F x 2
  Vector theta;                  // #F, radians in (-pi, pi]
  PlaneVectors gradient;         // #F x 2: grad theta now, radians / length
  Vector vertex_theta;           // #V, radians in (-pi, pi]; 0 at vertices without an active triangle
  PlaneVectors vertex_gradient;  // #V x 2: mean of grad theta around the vertex
  int family = 0;

  Vector2 mean_gradient() const { return (gradient.transpose() * area) / area.sum(); }
};

}  // namespace reflines
