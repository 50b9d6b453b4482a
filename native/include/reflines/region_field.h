// The input of the builders of targets: a region's triangles in the image plane and its current reflection lines.
#pragma once

#include "reflines/types.h"

namespace reflines {

// Of the region's diagonal: a strong bend that reaches farther is design, for the tools that know no length of their
// own.
constexpr double kFeatureLength = 1.0 / 6.0;

// Rows follow the region's triangles (#F) and vertices (#V). Image-plane coordinates are those of the world origin: the
// point V has the coordinates (V.x_axis, V.y_axis) of the optimizer's frame.
struct RegionField {
  PlanePositions xy;      // #V x 2
  Triangles F;            // #F x 3
  Eigen::VectorXi piece;  // #F: number of the height-field piece, -1 for triangles of none: those are not read
  Mask feature;           // #F: strong bends that run on (strong_features at kFeatureLength): tools keep their lines
  Vector area;            // #F: projected; 0 where not active
  PlanePositions center;  // #F x 2
  Vector theta;           // #F, radians in (-pi, pi]
  PlaneVectors gradient;  // #F x 2: grad theta now, radians / length
  Vector vertex_theta;    // #V, radians in (-pi, pi]; 0 at vertices without an active triangle
  PlaneVectors vertex_gradient;  // #V x 2: mean of grad theta around the vertex
  PlaneVectors vertex_slope;     // #V x 2: of the heights
  int family = 0;

  bool active(int t) const { return piece(t) >= 0; }
  Vector2 mean_gradient() const { return (gradient.transpose() * area) / area.sum(); }
};

}  // namespace reflines
