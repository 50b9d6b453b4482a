// Families of light lines as Python hands them over.
#pragma once

#include <vector>

#include "native/types.h"

namespace reflines {

// Of 3 numbers, or of #families x 3. InvalidInput for other shapes.
std::vector<Vector3> directions(const Eigen::MatrixXd& lines);

}  // namespace reflines
