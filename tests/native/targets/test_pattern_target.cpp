#include <gtest/gtest.h>

#include <numbers>

#include "reflines/pattern_target.h"
#include "tests/native/sample_meshes.h"

namespace reflines {
namespace {

constexpr int kPixels = 5;  // the vertices of 4 x 4 cells lie at the middles of 5 x 5 pixels

RegionField flat_region() {
  const samples::Mesh mesh = samples::grid(kPixels - 1);
  const Eigen::Index triangles = mesh.F.rows();
  RegionField region;
  region.xy = mesh.V.leftCols<2>();
  region.F = mesh.F;
  region.piece.setZero(triangles);
  region.response.setOnes(triangles);
  region.area.setConstant(triangles, 1.0 / static_cast<double>(triangles));
  region.theta.setZero(triangles);
  region.gradient.setZero(triangles, 2);
  return region;
}

// The mean of the three pixels under each triangle, of a picture that is not turned.
Vector average_pixels(const RegionField& region, const Eigen::MatrixXd& image) {
  Vector result = Vector::Zero(region.F.rows());
  for (int t = 0; t < result.size(); ++t) {
    for (const int v : region.F.row(t)) result(t) += image(v / kPixels, v % kPixels) / 3;
  }
  return result;
}

Vector lay_over(const RegionField& region, const Eigen::MatrixXd& image, double angle) {
  PatternOptions options;
  options.centre = Vector2(0.5, 0.5);
  options.width = kPixels / (kPixels - 1.0);
  options.angle = angle;
  options.by_value = true;
  return build_pattern_target(region, image, options).theta;
}

TEST(PatternTarget, TurnsThePictureCounterClockwise) {
  const RegionField region = flat_region();
  const Eigen::MatrixXd image = Eigen::MatrixXd::Random(kPixels, kPixels);
  Eigen::MatrixXd turned = image;
  for (int quarter = -4; quarter <= 4; ++quarter) {
    turned = image;
    // A quarter turn takes (x, y) to (-y, x): what was right is then on top.
    for (int k = 0; k < (quarter + 4) % 4; ++k) turned = Eigen::MatrixXd(turned.transpose().rowwise().reverse());
    const Vector theta = lay_over(region, image, quarter * std::numbers::pi / 2);
    EXPECT_LT((theta - average_pixels(region, turned)).cwiseAbs().maxCoeff(), 1e-13) << quarter << " quarters";
  }
}

}  // namespace
}  // namespace reflines
