// Reads the directions of the families of light lines from an array of 3 or #families x 3 numbers.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// Converts 3 numbers, or #families x 3. Throws InvalidInput for other shapes.
std::vector<Vector3> read_line_directions(const Eigen::MatrixXd& lines);

}  // namespace reflines
