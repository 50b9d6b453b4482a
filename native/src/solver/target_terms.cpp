#include "solver/target_terms.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "reflection/element.h"
#include "reflines/errors.h"

namespace reflines {
namespace {

// The weight of the term that crosses the lines. A free border leaves the profile along the lines undetermined (theta ~
// f_x: any g(y) is free; null space 9 on a free 8 x 8 grid). A second family across the first, whose target is its
// start, leaves only affine functions, which the proximity term determines. Of the two, the second family is
// independent of position and bends nothing, so it may be the stronger one. Where no eye of the targets sees a
// triangle, it alone determines the shape there.
constexpr double kCrossingWeight = 1e-3;

// The weight of the gradient beside a value fit. Eq. 3 depends on slopes only, and a misfit of theta costs no more than
// 4 however steep: what a fixed border forbids is hidden in a cliff one triangle wide. The wanted gradient, at the
// scale of the triangles, removes the cliff and vanishes with their size.
constexpr double kValueCompanion = 10.0;

// Returns the factor that makes misfits of values comparable. They are angles, those of gradients angles per length,
// and so are the crossing term's and, by its own scale, the proximity's: a wave of theta as long as the piece costs the
// same by value and by gradient, whatever the unit of length.
double value_scale(const HeightField& field) { return std::pow(2 * std::numbers::pi / field.piece_diagonal(), 2); }

double squared_misfit(const Target& target, const ReflectionFunction& lines, const Vector5& u, int row) {
  if (target.theta.size() > 0) {
    const double off = wrap_angle(lines.theta(u(0), u(1)) - target.theta(row));
    return off * off;
  }
  const Vector2 now = theta_gradient(lines.derivatives(u(0), u(1), 1), u);
  return (now - target.gradient.row(row).transpose()).squaredNorm();
}

}  // namespace

TargetTerms::TargetTerms(const HeightField& field, const Quadrature& quadrature,
                         const std::vector<ReflectionFunction>& families, const std::vector<Vector>& trust,
                         int row_count)
    : field_(field), quadrature_(quadrature), families_(families), trust_(trust), row_count_(row_count) {}

EnergyTerm TargetTerms::build_term(const Target& target, bool by_value) const {
  EnergyTerm term{families_[target.family], {}, {}, Vector(row_count_)};
  term.gradient.resize(by_value ? 0 : row_count_, 2);
  term.theta.resize(by_value ? row_count_ : 0);
  const double scale = by_value ? value_scale(field_) : 1.0;
#pragma omp parallel for schedule(static) if (row_count_ > kWorthThreads)
  for (int k = 0; k < row_count_; ++k) {
    const int t = quadrature_.triangle_of(k), row = field_.source[t];
    const double wanted_weight = target.weight.size() > 0 ? target.weight(row) : 1.0;
    term.weight(k) = scale * wanted_weight * quadrature_.weight_of(k) * field_.area(t) * trust_[target.family](t);
    if (by_value) {
      term.theta(k) = target.theta(row);
    } else {
      term.gradient.row(k) = target.gradient.row(row);
    }
  }
  return term;
}

EnergyTerm TargetTerms::build_companion(const Target& target) const {
  if (!target.gradient.allFinite()) {
    const auto good = target.gradient.array().isFinite().rowwise().all().count();
    throw InvalidInput("The gradient of the target for theta is not finite in " +
                       std::to_string(target.gradient.rows() - good) + " of its " +
                       std::to_string(target.gradient.rows()) + " rows; give numbers, or 0 rows for none.");
  }
  EnergyTerm result = build_term(target, false);
  const double scale = kValueCompanion * value_scale(field_);
  for (int k = 0; k < row_count_; ++k) result.weight(k) *= scale * field_.area(quadrature_.triangle_of(k));
  return result;
}

EnergyTerm TargetTerms::build_crossing(const PlaneVectors& start, const Vector& fraction) const {
  const int last = static_cast<int>(families_.size()) - 1;
  EnergyTerm term{families_[last], PlaneVectors(row_count_, 2), {}, Vector(row_count_)};
  for (int k = 0; k < row_count_; ++k) {
    const int t = quadrature_.triangle_of(k);
    term.gradient.row(k) = start.row(t);
    term.weight(k) = kCrossingWeight * quadrature_.weight_of(k) * field_.area(t) * trust_[last](t) * fraction(t);
  }
  return term;
}

TargetTerms::Misfit TargetTerms::measure(const std::vector<Target>& targets, const TriangleDerivatives& u) const {
  Vector squared = Vector::Zero(row_count_);
#pragma omp parallel for schedule(static) if (row_count_ > kWorthThreads)
  for (int k = 0; k < row_count_; ++k) {
    const int t = quadrature_.triangle_of(k);
    if (!field_.has_free_vertex(t)) continue;
    for (const Target& target : targets)
      squared(k) += squared_misfit(target, families_[target.family], u.row(k), field_.source[t]);
  }
  return sum(std::move(squared));
}

TargetTerms::Misfit TargetTerms::measure_evaluated(const Target& target, const Energy& energy, const Vector& z) const {
  const Vector& weight = energy.only_term()->weight;
  Vector squared = Vector::Zero(row_count_);
#pragma omp parallel for schedule(static) if (row_count_ > kWorthThreads)
  for (int k = 0; k < row_count_; ++k) {
    const int t = quadrature_.triangle_of(k);
    if (!field_.has_free_vertex(t)) continue;
    squared(k) = weight(k) > 0 ? energy.triangle_energies()(k) / weight(k)
                               : squared_misfit(target, families_[target.family],
                                                apply_stencil(energy.stencils(), k, z), field_.source[t]);
  }
  return sum(std::move(squared));
}

// Sums squared misfits of triangles. That of held triangles is constant, and says nothing about the solve.
TargetTerms::Misfit TargetTerms::sum(Vector squared) const {
  double area = 0;
  for (int k = 0; k < row_count_; ++k) {
    const int t = quadrature_.triangle_of(k);
    const double own = field_.has_free_vertex(t) ? quadrature_.weight_of(k) * field_.area(t) : 0.0;
    squared(k) *= own;
    area += own;
  }
  return {squared.sum(), area};
}

std::vector<EnergyTerm> TargetTerms::build(const std::vector<Target>& targets) const {
  std::vector<EnergyTerm> terms;
  for (const Target& target : targets) {
    terms.push_back(build_term(target, target.theta.size() > 0));
    if (target.theta.size() > 0 && target.gradient.rows() == target.theta.size())
      terms.push_back(build_companion(target));
  }
  return terms;
}

}  // namespace reflines
