// Values on triangles with several components.
#pragma once

#include "reflines/types.h"

namespace reflines {

// One row a triangle, one column a component, such as the two of the lines' field for each family of lights.
using TriangleFields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace reflines
