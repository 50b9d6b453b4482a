#include "solver/piece_smoother.h"

#include <limits>
#include <utility>

#include "optimization/linear/dissection.h"
#include "optimization/linear/linear_solver.h"
#include "reflection/strong_features.h"

namespace reflines {
namespace {

// The longest gradient, relative to that of a strong bend: smoothing shortens longer gradients, and longer changes, to
// it. A roof with its rails moves by 9 mm so, and by 131 without it.
constexpr double kOutlier = 4.0;

}  // namespace

PieceSmoother::PieceSmoother(const HeightField& field, const Stencils& stencils,
                             const std::vector<ReflectionFunction>& families, const std::vector<Vector>& trust,
                             bool limit_outliers, LinearSolverKind solver)
    : field_(field),
      stencils_(stencils),
      families_(families),
      trust_(trust),
      limit_outliers_(limit_outliers),
      solver_(solver),
      isotropic_(families.size()),
      directional_(families.size()),
      features_(families.size()),
      linear_(families.size()) {}

bool PieceSmoother::Cache::serves(const SmoothOptions& options, const PlaneVectors& wanted_along) const {
  return smoother && length == options.length && wanted_along.rows() == along.rows() && wanted_along == along;
}

const PlaneVectors& PieceSmoother::Cache::smooth(const PlaneVectors& gradient) {
  if (input.rows() == gradient.rows() && input == gradient) return output;
  output = smoother->smooth(gradient, longest);
  input = gradient;
  return output;
}

PlaneVectors PieceSmoother::smooth(const PlaneVectors& gradient, const SmoothOptions& options, int family) {
  const PlaneVectors& isotropic =
      update(isotropic_[family], {options.length, false}, PlaneVectors(0, 2), family).smooth(gradient);
  return options.directional ? update(directional_[family], options, isotropic, family).smooth(gradient) : isotropic;
}

PieceSmoother::Cache& PieceSmoother::update(Cache& cache, const SmoothOptions& options, const PlaneVectors& along,
                                            int family) {
  if (cache.serves(options, along)) return cache;
  enter(0.0, "finding features");
  const Mask& held = features(options.length, family);
  cache = {build(options, along, family, held), options.length, longest_gradient(family), along, {}, {}};
  return cache;
}

// Returns a kept isotropic system with these arguments, or null: families that see every triangle have the same one,
// and so have smoothing and score where no feature is kept.
std::shared_ptr<const LineSmoother> PieceSmoother::find_same(double length, int family, const Mask& features) const {
  for (const auto* caches : {&isotropic_, &linear_}) {
    for (const Cache& cache : *caches) {
      if (cache.smoother && cache.smoother->is_same(length, trust_[family], features)) return cache.smoother;
    }
  }
  return nullptr;
}

std::shared_ptr<const LineSmoother> PieceSmoother::build(const SmoothOptions& options, const PlaneVectors& along,
                                                         int family, const Mask& features) {
  if (!options.directional) {
    if (auto same = find_same(options.length, family, features)) return same;
  }
  enter(0.1, "assembling the smoothing");
  if (!elements_) elements_ = std::make_unique<SmootherElements>(make_smoother_elements(field_));
  throw_if_cancelled(progress_);
  return std::make_shared<LineSmoother>(
      field_, *elements_, options, along, trust_[family], features,
      [this](const SparseMatrix& matrix) { return factorize(matrix); }, progress_);
}

PlaneVectors PieceSmoother::smooth_all(const PlaneVectors& gradient, double length, int family) {
  Cache& cache = linear_[family];
  const SmoothOptions options{.length = length};
  const PlaneVectors nothing(0, 2);
  if (!cache.serves(options, nothing)) {
    const Mask none = Mask::Constant(gradient.rows(), false);
    cache = {build(options, nothing, family, none), length, std::numeric_limits<double>::infinity(), nothing, {}, {}};
  }
  return cache.smooth(gradient);
}

SpdSolve PieceSmoother::factorize(const SparseMatrix& matrix) const {
  auto solver = std::make_shared<LinearSolver>(solver_);
  enter(0.3, "ordering the smoothing");
  solver->analyze(matrix, dissection_order(matrix, field_.xy, progress_), progress_);
  enter(0.6, "factorizing the smoothing");
  solver->factorize(matrix, progress_);
  enter(0.9, "smoothing");
  return [solver](Vector& x) { solver->solve(x); };
}

const Mask& PieceSmoother::features(double length, int family) {
  Features& features = features_[family];
  if (features.length != length) features = {length, strong_features(field_, start_gradient(family), length)};
  return features.mask;
}

PlaneVectors PieceSmoother::start_gradient(int family) const {
  TriangleDerivatives u;
  apply_stencils(stencils_, field_.z, u);
  return reflection_field(families_[family], u).gradient;
}

double PieceSmoother::longest_gradient(int family) const {
  if (!limit_outliers_) return std::numeric_limits<double>::infinity();
  return kOutlier * strong_bend(start_gradient(family), field_.piece_diagonal());
}

void PieceSmoother::enter(double fraction, const char* stage) const {
  if (progress_ != nullptr) progress_->enter(fraction, stage);
}

}  // namespace reflines
