// What is asked of a piece: the terms of its energy, and what its heights lack of them.
#include <cmath>
#include <numbers>
#include <string>

#include "native/errors.h"
#include "native/piece_problem.h"
#include "native/reflection/element.h"

namespace reflines {
namespace {

// A free border leaves the profile along the lines undetermined (theta ~ f_x: any g(y) is free; null space 9 on a free
// 8 x 8 grid). A second family across the first, asked to stay as it is, leaves only affine functions; the proximity
// holds those. Of the two, the second family is blind to position and bends nothing, so it may be the stronger one.
constexpr double kCrossingWeight = 1e-3;

// Eq. 3 sees slopes only, and a misfit of theta costs no more than 4 however steep: what a fixed border forbids is
// hidden in a cliff one triangle wide (on a real bonnet 100 iterations, wobble 23 -> 4e6 degrees). The wanted gradient,
// at the scale of the triangles, takes the cliff away and vanishes with their size. Of 0, 1, 3, 10 and 30, theta raised
// by 0.2 inside a fixed border: wobble 0.09 -> 2e7, 28, 0.19, 0.11, 0.10; theta on the bonnet ends 0.019, 0.026, 0.027,
// 0.028, 0.028 beside the wish.
constexpr double kValueCompanion = 10.0;

// Misfits of values are angles, those of gradients angles per length, and so are the crossing term's and, by its own
// scale, the proximity's: a wave of theta as long as the piece costs the same by value and by gradient, whatever the
// unit of length. Without it a free pattern by value moved nothing in kilometres and five times too far in millimetres.
// Of 1, 4, (2 pi)^2 and 400 over the squared diagonal, ripples on a panel free on all sides: 26, 10, 1.3, 0.1 % of
// theta stay beside the wish, by 4, 5, 7, 8 steps.
double value_scale(const HeightField& field) { return std::pow(2 * std::numbers::pi / field.diagonal(), 2); }

double squared_misfit(const Target& target, const ReflectionFunction& lines, const Vector5& u, int row) {
  if (target.theta.size() > 0) {
    const double off = wrapped(lines.theta(u(0), u(1)) - target.theta(row));
    return off * off;
  }
  const Vector2 now = theta_gradient(lines.derivatives(u(0), u(1), 1), u);
  return (now - target.gradient.row(row).transpose()).squaredNorm();
}

}  // namespace

bool PieceProblem::is_changeable(int t) const {
  const HeightField& field = piece_.field;
  bool changeable = false;
  for (int i = 0; i < 3; ++i) changeable = changeable || field.role[field.F(t, i)] == VertexRole::kFree;
  return changeable;
}

Mask PieceProblem::changeable() const {
  Mask result(piece_.field.triangle_count());
  for (int t = 0; t < result.size(); ++t) result(t) = is_changeable(t);
  return result;
}

EnergyTerm PieceProblem::term(const Target& target) const {
  const HeightField& field = piece_.field;
  EnergyTerm term{families_[target.family], {}, {}, Vector(counted())};
  const bool by_value = target.theta.size() > 0;
  term.gradient.resize(by_value ? 0 : counted(), 2);
  term.theta.resize(by_value ? counted() : 0);
  const double scale = by_value ? value_scale(field) : 1.0;
  for (int k = 0; k < counted(); ++k) {
    const int t = triangle(k), row = field.source[t];
    const double wanted_weight = target.weight.size() > 0 ? target.weight(row) : 1.0;
    term.weight(k) = scale * wanted_weight * share(k) * field.area(t) * visible_[target.family](t);
    if (by_value) {
      term.theta(k) = target.theta(row);
    } else {
      term.gradient.row(k) = target.gradient.row(row);
    }
  }
  return term;
}

EnergyTerm PieceProblem::companion_term(const Target& target) const {
  if (!target.gradient.allFinite()) {
    const auto good = target.gradient.array().isFinite().rowwise().all().count();
    throw InvalidInput("The gradient of the target for theta is not finite in " +
                       std::to_string(target.gradient.rows() - good) + " of its " +
                       std::to_string(target.gradient.rows()) + " rows; give numbers, or 0 rows for none.");
  }
  EnergyTerm result = term({target.gradient, target.weight, {}, target.family});
  const double scale = kValueCompanion * value_scale(piece_.field);
  for (int k = 0; k < counted(); ++k) result.weight(k) *= scale * piece_.field.area(triangle(k));
  return result;
}

EnergyTerm PieceProblem::crossing_term() const {
  const int last = static_cast<int>(families_.size()) - 1;
  const PlaneVectors start = field_of(piece_.field.z, last).gradient;
  EnergyTerm term{families_[last], PlaneVectors(counted(), 2), {}, Vector(counted())};
  for (int k = 0; k < counted(); ++k) {
    const int t = triangle(k);
    term.gradient.row(k) = start.row(t);
    term.weight(k) = kCrossingWeight * share(k) * piece_.field.area(t) * visible_[last](t);
  }
  return term;
}

PieceProblem::Misfit PieceProblem::misfit(const std::vector<Target>& targets) {
  const HeightField& field = piece_.field;
  TriangleDerivatives u;
  apply_stencils(energy_.stencils(), z_, u);
  Vector squared(counted()), area(counted());
#pragma omp parallel for schedule(static) if (counted() > kWorthThreads)
  for (int k = 0; k < counted(); ++k) {
    const int t = triangle(k);
    area(k) = squared(k) = 0;
    if (!is_changeable(t)) continue;  // what is held stays as far off as it is, and says nothing about the solve
    double sum = 0;
    for (const Target& target : targets)
      sum += squared_misfit(target, families_[target.family], u.row(k), field.source[t]);
    area(k) = share(k) * field.area(t);
    squared(k) = area(k) * sum;
  }
  return {squared.sum(), area.sum()};
}

void PieceProblem::set_targets(const std::vector<Target>& targets) {
  std::vector<EnergyTerm> terms;
  for (const Target& target : targets) {
    terms.push_back(term(target));
    if (target.theta.size() > 0 && target.gradient.rows() == target.theta.size())
      terms.push_back(companion_term(target));
  }
  if (free_border_ && !pulled_) terms.push_back(crossing_term());
  energy_.set_terms(std::move(terms));
}

}  // namespace reflines
