#include "geometry/stencil_quality.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "geometry/local_monomials.h"

namespace reflines {

double stencil_magnitude(const HeightField& field, const HessianStencil& stencil) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) {
    const Vector2 p = field.xy.row(stencil.vertex[i]);
    for (size_t k = 0; k < stencil.vertex.size(); ++k) {
      // Opposite vertex 3 + i is on no edge with corner i.
      if (k == static_cast<size_t>(3 + i)) continue;
      longest = std::max(longest, (field.xy.row(stencil.vertex[k]).transpose() - p).squaredNorm());
    }
  }
  return stencil.weight.cwiseAbs().maxCoeff() * longest;
}

double affine_magnitude(const HeightField& field, const HessianStencil& stencil) {
  const PlanePositions points = field.xy(stencil.vertex, Eigen::all);
  const PlanePositions centred = points.rowwise() - points.colwise().mean();
  const Eigen::Matrix2d covariance = centred.transpose() * centred / static_cast<double>(points.rows());
  const Eigen::Matrix2d scale = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).operatorSqrt();
  double largest = 0;
  for (Eigen::Index k = 0; k < stencil.weight.cols(); ++k) {
    Eigen::Matrix2d hessian;
    hessian << stencil.weight(0, k), stencil.weight(1, k), stencil.weight(1, k), stencil.weight(2, k);
    largest = std::max(largest, (scale * hessian * scale).norm());
  }
  return largest;
}

double cubic_error(const HeightField& field, int t, const HessianStencil& stencil) {
  const LocalMonomials monomials = local_monomials(field, t, stencil.vertex);
  const Eigen::Matrix<double, 4, 3> error = monomials.value.bottomRows<4>() * stencil.weight.transpose();
  return error.cwiseAbs().maxCoeff() * monomials.size * monomials.size;
}

}  // namespace reflines
