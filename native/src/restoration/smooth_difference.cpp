#include "restoration/smooth_difference.h"

#include <Eigen/Cholesky>

#include "base/parallel_failure.h"
#include "restoration/disk_mean.h"
#include "restoration/press_rules.h"
#include "restoration/soft_step.h"

namespace reflines {
namespace {

constexpr int kTerms = 6;        // of a quadratic: 1, x, y, x^2, x y, y^2
constexpr int kMoments = 15;     // of two variables, up to the fourth degree
constexpr double kRidge = 1e-9;  // relative: where a disk has too few points
constexpr int kChunk = 256;      // points for a thread
constexpr int kPower[kTerms][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};

using Quadratic = Eigen::Matrix<double, kTerms, 1>;
using QuadraticMap = Eigen::Matrix<double, kTerms, kTerms>;

// Returns the column of x^i y^j among all monomials.
int find_column(int i, int j) { return (i + j) * (i + j + 1) / 2 + j; }

// Returns the monomials of places (#V x 2) up to the fourth degree.
Eigen::MatrixXd find_monomials(const PlanePositions& q) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Ones(q.rows(), kMoments);
  for (int degree = 1; degree <= 4; ++degree) {
    for (int j = 0; j <= degree; ++j) {
      const int i = degree - j;
      const auto lower = result.col(i > 0 ? find_column(i - 1, j) : find_column(i, j - 1));
      result.col(find_column(i, j)) = lower.cwiseProduct(q.col(i > 0 ? 0 : 1));
    }
  }
  return result;
}

// Returns the map of a quadratic's terms to those about a place.
QuadraticMap move_origin(const Vector2& p) {
  QuadraticMap result = QuadraticMap::Identity();
  result.col(0) << 1.0, -p.x(), -p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
  result.col(1).tail<3>() << -2.0 * p.x(), -p.y(), 0.0;
  result.col(2).tail<3>() << 0.0, -p.x(), -2.0 * p.y();
  return result;
}

// Returns the value at a place of the quadratic by least squares, of the mean monomials (15) and the mean terms times
// the values (6) around it.
double fit_quadratic(const Eigen::RowVectorXd& means, const Vector2& place) {
  QuadraticMap A;
  for (int r = 0; r < kTerms; ++r) {
    for (int c = 0; c < kTerms; ++c)
      A(r, c) = means(find_column(kPower[r][0] + kPower[c][0], kPower[r][1] + kPower[c][1]));
  }
  const QuadraticMap about = move_origin(place);
  A = about * A * about.transpose();
  const double trace = A.trace();
  if (!(trace > 0)) return 0.0;
  A.diagonal().array() += kRidge * trace;
  const Quadratic b = about * means.tail<kTerms>().transpose();
  return A.ldlt().solve(b)(0);
}

}  // namespace

Vector find_smooth_difference(const PlanePositions& q, const Vector& difference, const Mask& counts, double length,
                              double least) {
  if (difference.cwiseAbs().maxCoeff() <= least) return Vector::Zero(difference.size());
  const double radius = kRules.symmetry.smooth * length;
  const Vector2 centre = q.colwise().mean();
  const PlanePositions places = (q.rowwise() - centre.transpose()) / radius;
  const Vector weight = counts.cast<double>();
  const DiskMean mean(q, Vector::Ones(q.rows()), radius);
  const Eigen::MatrixXd monomials = weight.asDiagonal() * find_monomials(places);
  Eigen::MatrixXd columns(q.rows(), kMoments + kTerms);
  columns << monomials, difference.asDiagonal() * monomials.leftCols(kTerms);
  columns = mean.of_columns(columns);
  Vector result(q.rows());
  run_parallel(static_cast<int>(q.rows()), kChunk,
               [&](int v) { result(v) = fit_quadratic(columns.row(v), places.row(v).transpose()); });
  Eigen::MatrixXd squares(q.rows(), 2);
  squares << weight.cwiseProduct(result.cwiseAbs2()), weight.cwiseProduct((difference - result).cwiseAbs2());
  squares = mean.of_columns(squares);
  for (Eigen::Index v = 0; v < result.size(); ++v) {
    const double explained = squares(v, 0) / (squares.row(v).sum() + least * least);
    result(v) *= soft_step(kRules.symmetry.explained, explained);
  }
  return result;
}

}  // namespace reflines
