#include <gtest/gtest.h>

#include <cmath>

#include "restoration/length_choice.h"

namespace reflines {
namespace {

constexpr int kSide = 40;
constexpr double kLength = 4.0;

PlanePositions places() {
  PlanePositions result(kSide * kSide, 2);
  for (int t = 0; t < result.rows(); ++t) result.row(t) << t % kSide, t / kSide;
  return result;
}

Eigen::MatrixXd flaws() { return Eigen::MatrixXd::Ones(kSide * kSide, 3); }

// Changes of a field (#T x 2) by four lengths; `gone` tells for each place from which length on its flaw is gone: the
// change then stays, but for a design that is bent the more the longer the length.
std::vector<TriangleFields> changes_where(const std::vector<int>& gone) {
  std::vector<TriangleFields> result;
  for (int k = 0; k < 4; ++k) {
    TriangleFields change(kSide * kSide, 2);
    for (int t = 0; t < change.rows(); ++t) {
      const double flaw = k >= gone[t] ? 1.0 : 0.2 * k, design = 1e-6 * std::pow(16.0, k);
      change.row(t) << flaw + design, -0.5 * flaw;
    }
    result.push_back(change);
  }
  return result;
}

TEST(LengthChoice, TakesTheShortestLengthThatTakesTheFlawWhole) {
  const PlanePositions xy = places();
  std::vector<int> gone(xy.rows());
  for (int t = 0; t < xy.rows(); ++t) gone[t] = xy(t, 0) < kSide / 2 ? 0 : 2;
  const Eigen::MatrixXd share = share_lengths(changes_where(gone), flaws(), xy, Vector::Ones(xy.rows()), kLength);
  ASSERT_EQ(share.cols(), 3);
  for (int t = 0; t < xy.rows(); ++t) {
    EXPECT_NEAR(share.row(t).sum(), 1.0, 1e-14);
    if (std::abs(xy(t, 0) - (kSide - 1) / 2.0) > kLength) {
      EXPECT_GT(share(t, gone[t]), 0.999) << t;
    }
  }
}

// A design that each longer length bends more: the difference of the first two is the least.
TEST(LengthChoice, TakesTheShortestWhereAllLengthsTakeOfTheDesign) {
  const PlanePositions xy = places();
  std::vector<TriangleFields> changes;
  for (int k = 0; k < 4; ++k) changes.push_back(TriangleFields::Constant(xy.rows(), 2, std::pow(2.0, k)));
  const Eigen::MatrixXd share = share_lengths(changes, flaws(), xy, Vector::Ones(xy.rows()), kLength);
  EXPECT_GT(share.col(0).minCoeff(), 0.999);
}

TEST(LengthChoice, TakesNoLengthWhoseChangeIsDesign) {
  const PlanePositions xy = places();
  const std::vector<TriangleFields> none(4, TriangleFields::Zero(xy.rows(), 2));
  Eigen::MatrixXd weight = flaws();
  weight.col(2).setConstant(0.1);
  const Eigen::MatrixXd share = share_lengths(none, weight, xy, Vector::Ones(xy.rows()), kLength);
  EXPECT_NEAR(share.rowwise().sum().minCoeff(), 1.0, 1e-14);
  EXPECT_NEAR(share.col(1).minCoeff(), 1.0 / 2.01, 1e-14);
  EXPECT_NEAR(share.col(2).maxCoeff(), 0.01 / 2.01, 1e-14);
}

TEST(LengthChoice, SharesEquallyWhereNothingChanges) {
  const PlanePositions xy = places();
  const std::vector<TriangleFields> none(4, TriangleFields::Zero(xy.rows(), 2));
  const Eigen::MatrixXd share = share_lengths(none, flaws(), xy, Vector::Ones(xy.rows()), kLength);
  EXPECT_NEAR((share.array() - 1.0 / 3.0).abs().maxCoeff(), 0.0, 1e-15);
}

}  // namespace
}  // namespace reflines
