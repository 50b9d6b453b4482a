#include "reflection/line_smoother.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/vertex_hessian.h"
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

// Longest length relative to the region's size: all that is longer smooths as much, and 1e100 would overflow.
constexpr double kLongest = 1e6;

// The coefficients of H^3, H^2, H and 1 in p(H) / H^4.
constexpr double kSharpened[4] = {-20.0, 70.0, -84.0, 35.0};

PlaneVectors shorten(const PlaneVectors& gradient, double longest) {
  if (!std::isfinite(longest)) return gradient;
  const Vector factor = (longest / gradient.rowwise().norm().array().max(longest)).matrix();
  return factor.asDiagonal() * gradient;
}

Vector data_weights(const HeightField& field, const Vector& trust, const Mask& features) {
  const Vector weight = trust.cwiseMax(kLeastTrust).cwiseProduct(field.area);
  return (weight.array() * features.select(Vector::Constant(weight.size(), kFeatureWeight).array(), 1.0)).matrix();
}

// Returns the quadratic form of a Hessian (xx, sqrt(2) xy, yy): its squared norm, or the square of the second
// derivative along the level lines of `gradient`.
Eigen::Matrix3d second_order_energy(bool directional, const Vector2& gradient) {
  if (!directional || gradient.norm() == 0) return Eigen::Matrix3d::Identity();
  const Vector2 along = Vector2(-gradient.y(), gradient.x()).normalized();
  const Vector3 c(along.x() * along.x(), std::numbers::sqrt2 * along.x() * along.y(), along.y() * along.y());
  return c * c.transpose() + kAcrossLines * Eigen::Matrix3d::Identity();
}

// Returns the mean of the triangles' quadratic forms at each vertex.
std::vector<Eigen::Matrix3d> average_forms(const HeightField& field, bool directional, const PlaneVectors& along) {
  std::vector<Eigen::Matrix3d> sum(field.vertex_count(), Eigen::Matrix3d::Zero());
  Vector around = Vector::Zero(field.vertex_count());
  for (int t = 0; t < field.triangle_count(); ++t) {
    const Vector2 gradient = directional ? Vector2(along.row(t)) : Vector2::Zero();
    const Eigen::Matrix3d form = field.area(t) * second_order_energy(directional, gradient);
    for (int i = 0; i < 3; ++i) {
      sum[field.F(t, i)] += form;
      around(field.F(t, i)) += field.area(t);
    }
  }
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (around(v) > 0) sum[v] /= around(v);
  }
  return sum;
}

// Returns the elements' matrices: the upper triangle of a 5 x 5 matrix row by row, where 0 is the mean's and 9 .. 14
// are those of a patch's Hessian.
Energy::ElementHessians weigh_elements(const HeightField& field, const SmootherElements& shared,
                                       const SmoothOptions& options, const PlaneVectors& along, const Vector& weight) {
  const double stiffness = std::pow(options.length / (2 * std::numbers::pi), 4);
  const std::vector<Eigen::Matrix3d> form = average_forms(field, options.directional, along);
  Energy::ElementHessians result = Energy::ElementHessians::Zero(shared.stencils.triangle_count(), 15);
  result.col(0).head(weight.size()) = (1.0 - kCornerFraction) * weight;
  for (int p = 0; p < static_cast<int>(shared.center.size()); ++p) {
    const Eigen::Matrix3d K = stiffness * form[shared.center[p]];
    result.row(weight.size() + p).tail<6>() << K(0, 0), K(0, 1), K(0, 2), K(1, 1), K(1, 2), K(2, 2);
  }
  return result;
}

// Appends an element with its vertices, without weights.
void append_element(const int* vertex, Eigen::Index count, Stencils& stencils) {
  stencils.vertex.insert(stencils.vertex.end(), vertex, vertex + count);
  stencils.offset.push_back(static_cast<int>(stencils.vertex.size()));
}

double bound_length(const HeightField& field, double length) {
  const double size = (field.xy.colwise().maxCoeff() - field.xy.colwise().minCoeff()).norm();
  return std::min(length, kLongest * size);
}

}  // namespace

SmootherElements make_smoother_elements(const HeightField& field) {
  const std::vector<EdgeJump> edges = list_edge_jumps(field.xy, field.F, field.neighbors, field.area);
  const std::vector<VertexPatch> patches = gather_patches(edges, field.xy, field.F, field.area);
  SmootherElements result;
  Stencils& stencils = result.stencils;
  stencils.offset = {0};
  for (int t = 0; t < field.triangle_count(); ++t) append_element(field.F.row(t).data(), 3, stencils);
  for (const VertexPatch& patch : patches)
    append_element(patch.vertex.data(), static_cast<Eigen::Index>(patch.vertex.size()), stencils);
  stencils.hessian.setZero(static_cast<Eigen::Index>(stencils.vertex.size()), 3);
  stencils.gradient.setZero(stencils.triangle_count(), 6);
  for (int i = 0; i < 3; ++i) stencils.gradient.col(2 * i).head(field.triangle_count()).setConstant(1.0 / 3.0);
  for (size_t p = 0; p < patches.size(); ++p) {
    const int first = stencils.offset[field.triangle_count() + p];
    const PatchWeights weight = weigh_patch(patches[p], edges, {});
    stencils.hessian.middleRows(first, weight.cols()) = weight.transpose();
    result.center.push_back(patches[p].center);
  }
  return result;
}

LineSmoother::LineSmoother(const HeightField& field, const SmootherElements& shared, const SmoothOptions& options,
                           const PlaneVectors& along, const Vector& trust, Mask features, const SpdFactorize& factorize,
                           const Progress* progress)
    : field_(field), options_(options), features_(std::move(features)), weight_(data_weights(field, trust, features_)) {
  if (!(options.length > 0) || !std::isfinite(options.length)) {
    throw InvalidInput("The smoothing length must be a positive length in scene units, not " +
                       std::to_string(options.length) + ".");
  }
  options_.length = bound_length(field, options.length);
  const StencilEntries entries(shared.stencils, field.vertex_count());
  throw_if_cancelled(progress);
  std::vector<int> column(field.vertex_count());
  std::iota(column.begin(), column.end(), 0);
  HessianAssembly assembly(shared.stencils, entries, column, field.vertex_count());
  throw_if_cancelled(progress);
  const Energy::ElementHessians hessians = weigh_elements(field, shared, options_, along, weight_);
  throw_if_cancelled(progress);
  solve_ = factorize(assembly.assemble(hessians, corner_weights(field, weight_)));
}

bool LineSmoother::is_same(double length, const Vector& trust, const Mask& features) const {
  return !options_.directional && options_.length == bound_length(field_, length) && (features_ == features).all() &&
         weight_ == data_weights(field_, trust, features);
}

void LineSmoother::filter_once(Vector& g) const {
  Vector G = Vector::Zero(field_.vertex_count());
  for (int t = 0; t < field_.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) G(field_.F(t, i)) += weight_(t) / 3.0 * g(t);
  }
  solve_(G);
  for (int t = 0; t < field_.triangle_count(); ++t)
    g(t) = (G(field_.F(t, 0)) + G(field_.F(t, 1)) + G(field_.F(t, 2))) / 3.0;
}

// Applies p(H) = H^4 (35 - 84 H + 70 H^2 - 20 H^3), H the implicit step, by Horner's rule.
Vector LineSmoother::filter(const Vector& g) const {
  Vector result = kSharpened[0] * g;
  for (const double coefficient : {kSharpened[1], kSharpened[2], kSharpened[3]}) {
    filter_once(result);
    result += coefficient * g;
  }
  for (int power = 0; power < 4; ++power) filter_once(result);
  return result;
}

PlaneVectors LineSmoother::smooth(const PlaneVectors& gradient, double longest) const {
  const PlaneVectors data = shorten(gradient, longest);
  PlaneVectors result(field_.triangle_count(), 2);
  for (int component = 0; component < 2; ++component) result.col(component) = filter(data.col(component));
  for (int t = 0; t < field_.triangle_count(); ++t) {
    if (features_(t)) result.row(t) = gradient.row(t);
  }
  return gradient + shorten(result - gradient, longest);
}

}  // namespace reflines
