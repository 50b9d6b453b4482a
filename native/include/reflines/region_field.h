// The input of the builders of targets: a region's triangles in the image plane and its current reflection lines.
#pragma once

#include "reflines/types.h"

namespace reflines {

// The length, relative to the region's diagonal, beyond which a strong bend counts as a feature for the tools that have
// no length of their own.
constexpr double kFeatureLength = 1.0 / 6.0;

// The region and its lines as the builders of targets read them. Rows follow the region's triangles (#F) and vertices
// (#V). Image-plane coordinates have the world's origin: the point V has the coordinates (V.x_axis, V.y_axis) of the
// optimizer's frame.
struct RegionField {
  PlanePositions xy;      // #V x 2
  Triangles F;            // #F x 3
  Eigen::VectorXi piece;  // #F: number of the height-field piece, -1 for triangles of none: those are not read
  Mask feature;           // #F: extended strong bends (strong_features at kFeatureLength), whose lines the tools keep
  Vector response;        // #F in [0, 1]: how far tools change a triangle's lines; 0 on features, see measure_response
  Vector area;            // #F: projected; 0 where not active
  PlanePositions center;  // #F x 2
  Vector theta;           // #F, radians in (-pi, pi]
  PlaneVectors gradient;  // #F x 2: current grad theta, radians / length
  Vector vertex_theta;    // #V, radians in (-pi, pi]; 0 at vertices without an active triangle
  PlaneVectors vertex_gradient;  // #V x 2: mean of grad theta around the vertex
  PlaneVectors vertex_slope;     // #V x 2: gradient of the heights
  int family = 0;

  bool active(int t) const { return piece(t) >= 0; }
  Vector2 median_gradient() const;  // of all active triangles: the geometric median, by area
};

}  // namespace reflines
