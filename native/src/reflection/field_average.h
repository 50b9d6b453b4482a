// A local average of a field on triangles that preserves linear fields.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines {

// The average goes from triangles to vertices by the linear least squares fit to the centroids around each, and back by
// the mean of the three corners: linear fields are preserved, components that alternate between triangles are removed.
// For vertices on a border, on a crease or beside an excluded triangle, a triangle uses its own value.
class FieldAverage {
 public:
  explicit FieldAverage(const HeightField& field);  // must outlive this

  // Averages #T x 2 values. `counts` (#T) marks the triangles with meaningful values; the others become 0.
  PlaneVectors of(const PlaneVectors& values, const Mask& counts) const;

 private:
  const HeightField& field_;
  std::vector<double> weight_;  // weights of the triangles around each vertex, in the order of triangles_of_vertex
  Mask fitted_;                 // #V: the vertex has a fit
};

}  // namespace reflines
