#include "geometry/height_fit.h"

#include <Eigen/QR>
#include <cmath>

namespace reflines {
namespace {

// The pivot of the decomposition, relative to the largest, below which the points do not determine a polynomial: points
// on three straight rows leave y^3 open, and rounding, or a jitter of a hundredth, would decide about it.
constexpr double kDetermined = 3e-3;

using Decomposition = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

// Returns the monomials of degrees 0 to `degree`, #P x 6 or 10, in units of `size`.
Eigen::MatrixXd list_monomials(const PlanePositions& points, double size, int degree) {
  const Eigen::ArrayXd x = points.col(0).array() / size, y = points.col(1).array() / size;
  Eigen::MatrixXd M(points.rows(), degree == 3 ? 10 : 6);
  M.leftCols(6) << Eigen::ArrayXd::Ones(x.size()), x, y, x * x, x * y, y * y;
  if (degree == 3) M.rightCols(4) << x * x * x, x * x * y, x * y * y, y * y * y;
  return M;
}

// Adds the third derivatives, from the coefficients c of the monomials M in units of `size`, and their standard error.
void add_third(const Eigen::MatrixXd& M, const Decomposition& decomposition, const Vector& heights, const Vector& c,
               double size, HeightFit& fit) {
  const Vector4 factor = Vector4(6, 2, 2, 6) / (size * size * size), times(1, 3, 3, 1);
  fit.third = factor.cwiseProduct(c.segment<4>(6));
  if (M.rows() <= M.cols()) return;
  const double variance = (heights - M * c).squaredNorm() / static_cast<double>(M.rows() - M.cols());
  const Eigen::MatrixXd picked =
      decomposition.colsPermutation().transpose() * Eigen::MatrixXd::Identity(M.cols(), M.cols()).middleCols(6, 4);
  const Eigen::MatrixXd root =
      decomposition.matrixR().topRows(M.cols()).triangularView<Eigen::Upper>().transpose().solve(picked);
  const Vector4 spread = root.colwise().squaredNorm().transpose();
  fit.third_error = std::sqrt(variance * times.dot(factor.cwiseAbs2().cwiseProduct(spread)));
}

}  // namespace

HeightFit fit_heights(const PlanePositions& points, const Vector& heights) {
  const double size = points.rowwise().norm().maxCoeff();
  for (const int degree : {3, 2}) {
    const Eigen::MatrixXd M = list_monomials(points, size, degree);
    if (M.rows() < M.cols()) continue;
    Decomposition decomposition;
    decomposition.setThreshold(kDetermined);
    if (decomposition.compute(M).rank() < M.cols()) continue;
    const Vector c = decomposition.solve(heights);
    HeightFit fit{degree, c(0), Vector2(c(1), c(2)) / size, Vector3(2 * c(3), c(4), 2 * c(5)) / (size * size)};
    if (degree == 3) add_third(M, decomposition, heights, c, size, fit);
    return fit;
  }
  return {};
}

}  // namespace reflines
