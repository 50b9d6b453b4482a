// Reads directions, of families of light lines or of their eyes, from an array of 3 or #families x 3 numbers.
#pragma once

#include <string>
#include <vector>

#include "reflines/types.h"

namespace reflines {

// Converts 3 numbers, or #families x 3. Throws InvalidInput for other shapes; `name` begins its sentence.
std::vector<Vector3> read_directions(const Eigen::MatrixXd& directions, const std::string& name);

inline std::vector<Vector3> read_line_directions(const Eigen::MatrixXd& lines) {
  return read_directions(lines, "A line direction");
}

}  // namespace reflines
