#include "python/line_directions.h"

#include "reflines/errors.h"

namespace reflines {

std::vector<Vector3> read_directions(const Eigen::MatrixXd& directions, const std::string& name) {
  const bool one = directions.cols() == 1 && directions.rows() == 3;
  if (!one && directions.cols() != 3) throw InvalidInput(name + " has three numbers; give 3, or #families x 3.");
  std::vector<Vector3> result;
  if (one) result.push_back(directions.col(0));
  for (Eigen::Index k = 0; !one && k < directions.rows(); ++k) result.push_back(directions.row(k));
  return result;
}

}  // namespace reflines
