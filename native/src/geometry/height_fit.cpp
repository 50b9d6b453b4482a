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

// Returns the variances of the coefficients (6 or 10), for heights whose errors have the variance 1.
Vector find_spread(const Decomposition& decomposition) {
  const Eigen::Index count = decomposition.cols();
  const Eigen::MatrixXd picked = decomposition.colsPermutation().transpose() * Eigen::MatrixXd::Identity(count, count);
  const Eigen::MatrixXd root =
      decomposition.matrixR().topRows(count).triangularView<Eigen::Upper>().transpose().solve(picked);
  return root.colwise().squaredNorm().transpose();
}

// Sets the derivatives of second and third degree, from the coefficients c of monomials in units of `size`, and their
// errors, from the squared residual, of which `more` heights than coefficients are left.
void set_derivatives(const Vector& c, double size, const Vector& spread, double residual, Eigen::Index more,
                     HeightFit& fit) {
  const Vector3 second = Vector3(2, 1, 2) / (size * size);
  const Vector4 third = Vector4(6, 2, 2, 6) / (size * size * size);
  const double variance = more > 0 ? residual / static_cast<double>(more) : std::numeric_limits<double>::infinity();
  fit.second = second.cwiseProduct(c.segment<3>(3));
  fit.second_error = std::sqrt(variance * Vector3(1, 2, 1).dot(second.cwiseAbs2().cwiseProduct(spread.segment<3>(3))));
  if (fit.degree < 3) return;
  fit.third = third.cwiseProduct(c.segment<4>(6));
  fit.third_error = std::sqrt(variance * Vector4(1, 3, 3, 1).dot(third.cwiseAbs2().cwiseProduct(spread.segment<4>(6))));
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
    HeightFit fit{degree, c(0), Vector2(c(1), c(2)) / size};
    set_derivatives(c, size, find_spread(decomposition), (heights - M * c).squaredNorm(), M.rows() - M.cols(), fit);
    return fit;
  }
  return {};
}

}  // namespace reflines
