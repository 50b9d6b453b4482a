#include "reflection/line_smoother.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "reflection/hessian_assembly.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

// The isotropic part of directional smoothing: without it nothing couples a line with its neighbours, and the system is
// singular wherever a line crosses fewer than three triangles.
constexpr double kAcrossLines = 1e-3;

// The fraction of the data term that compares each corner, not only the triangle's mean, with the triangle's gradient.
// A triangle connected by one vertex has two corners more than means; without this fraction they are undetermined and
// the system is singular. Linear fields are bent by it at the border, by this fraction at most.
constexpr double kCornerFraction = 1e-4;

Vector corner_weights(const HeightField& field, const Vector& weight) {
  Vector result = Vector::Zero(field.vertex_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) result(field.F(t, i)) += kCornerFraction * weight(t) / 3.0;
  }
  return result;
}

// The weight of a feature's data relative to 1: it determines the smoothed field where nothing else does, and bends
// nothing around it.
constexpr double kFeatureWeight = 1e-3;

// The least weight of untrusted data, which determine the smoothed field where nothing else does.
constexpr double kLeastTrust = 1e-6;

PlaneVectors shorten(const PlaneVectors& gradient, double longest) {
  if (!std::isfinite(longest)) return gradient;
  const Vector factor = (longest / gradient.rowwise().norm().array().max(longest)).matrix();
  return factor.asDiagonal() * gradient;
}

Vector data_weights(const HeightField& field, const Vector& trust, const Mask& features) {
  const Vector weight = trust.cwiseMax(kLeastTrust).cwiseProduct(field.area);
  return (weight.array() * features.select(Vector::Constant(weight.size(), kFeatureWeight).array(), 1.0)).matrix();
}

// Returns the stencils with the mean over the triangle in place of f_x, and zero in place of f_y.
Stencils replace_gradient_by_mean(Stencils stencils) {
  stencils.gradient.setZero();
  for (int i = 0; i < 3; ++i) stencils.gradient.col(2 * i).setConstant(1.0 / 3.0);
  return stencils;
}

// Returns the quadratic form |f_xx|^2 + 2 |f_xy|^2 + |f_yy|^2, or the square of the second derivative along the level
// lines of `gradient`.
Eigen::Matrix3d second_order_energy(bool directional, const Vector2& gradient) {
  const Eigen::Matrix3d isotropic = Vector3(1, 2, 1).asDiagonal();
  if (!directional || gradient.norm() == 0) return isotropic;
  const Vector2 along = Vector2(-gradient.y(), gradient.x()).normalized();
  const Vector3 c(along.x() * along.x(), 2 * along.x() * along.y(), along.y() * along.y());
  return c * c.transpose() + kAcrossLines * isotropic;
}

Energy::ElementHessians elements(const HeightField& field, const SmoothOptions& options, const PlaneVectors& along,
                                 const Vector& weight) {
  const double stiffness = std::pow(options.length / (2 * std::numbers::pi), 4);
  Energy::ElementHessians result = Energy::ElementHessians::Zero(field.triangle_count(), 15);
  for (int t = 0; t < field.triangle_count(); ++t) {
    const Eigen::Matrix3d K =
        field.area(t) * stiffness *
        second_order_energy(options.directional, options.directional ? Vector2(along.row(t)) : Vector2());
    // The upper triangle of a 5 x 5 matrix row by row: 0 is the mean's, 9 .. 14 are those of f_xx, f_xy, f_yy.
    result(t, 0) = (1.0 - kCornerFraction) * weight(t);
    result.row(t).tail<6>() << K(0, 0), K(0, 1), K(0, 2), K(1, 1), K(1, 2), K(2, 2);
  }
  return result;
}

}  // namespace

LineSmoother::LineSmoother(const HeightField& field, const Stencils& stencils, const SmoothOptions& options,
                           const PlaneVectors& along, const Vector& trust, Mask features, const SpdFactorize& factorize,
                           const Progress* progress)
    : field_(field), options_(options), features_(std::move(features)), weight_(data_weights(field, trust, features_)) {
  if (!(options.length > 0) || !std::isfinite(options.length)) {
    throw InvalidInput("The smoothing length must be a positive length in scene units, not " +
                       std::to_string(options.length) + ".");
  }
  const Stencils means = replace_gradient_by_mean(stencils);
  throw_if_cancelled(progress);
  const StencilEntries entries(means, field.vertex_count());
  throw_if_cancelled(progress);
  std::vector<int> column(field.vertex_count());
  std::iota(column.begin(), column.end(), 0);
  HessianAssembly assembly(means, entries, column, field.vertex_count());
  throw_if_cancelled(progress);
  const Energy::ElementHessians hessians = elements(field, options, along, weight_);
  throw_if_cancelled(progress);
  solve_ = factorize(assembly.assemble(hessians, corner_weights(field, weight_)));
}

bool LineSmoother::is_same(double length, const Vector& trust, const Mask& features) const {
  return !options_.directional && options_.length == length && (features_ == features).all() &&
         weight_ == data_weights(field_, trust, features);
}

PlaneVectors LineSmoother::smooth(const PlaneVectors& gradient, double longest) const {
  PlaneVectors result(field_.triangle_count(), 2);
  const PlaneVectors data = shorten(gradient, longest);
  for (int component = 0; component < 2; ++component) {
    Vector G = Vector::Zero(field_.vertex_count());
    for (int t = 0; t < field_.triangle_count(); ++t) {
      for (int i = 0; i < 3; ++i) G(field_.F(t, i)) += weight_(t) / 3.0 * data(t, component);
    }
    solve_(G);
    for (int t = 0; t < field_.triangle_count(); ++t) {
      const double mean = (G(field_.F(t, 0)) + G(field_.F(t, 1)) + G(field_.F(t, 2))) / 3.0;
      result(t, component) = features_(t) ? gradient(t, component) : mean;
    }
  }
  return gradient + shorten(result - gradient, longest);
}

}  // namespace reflines
