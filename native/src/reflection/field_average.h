// A local average of a field on triangles that keeps what is linear.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"

namespace reflines {

// From triangles to vertices by the linear least squares fit to the centroids around each, and back as the mean of the
// three corners: linear fields come back as they are, what alternates from triangle to triangle does not. At vertices
// on a border, on a crease or beside a triangle that does not count a triangle hands on its own value.
class FieldAverage {
 public:
  explicit FieldAverage(const HeightField& field);  // which must outlive this

  // #T x 2 of #T x 2. `counts` (#T): triangles whose values mean something; the others become 0.
  PlaneVectors of(const PlaneVectors& values, const Mask& counts) const;

 private:
  const HeightField& field_;
  std::vector<double> weight_;  // of every triangle around a vertex, in the order of triangles_of_vertex
  Mask fitted_;                 // #V
};

}  // namespace reflines
