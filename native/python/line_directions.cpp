#include "python/line_directions.h"

#include "reflines/errors.h"

namespace reflines {

std::vector<Vector3> read_line_directions(const Eigen::MatrixXd& lines) {
  const bool one = lines.cols() == 1 && lines.rows() == 3;
  if (!one && lines.cols() != 3) throw InvalidInput("A line direction has three numbers; give 3, or #families x 3.");
  std::vector<Vector3> result;
  if (one) result.push_back(lines.col(0));
  for (Eigen::Index k = 0; !one && k < lines.rows(); ++k) result.push_back(lines.row(k));
  return result;
}

}  // namespace reflines
