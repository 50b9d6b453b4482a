#include "native/piece_problem.h"

#include <algorithm>

#include "native/geometry/smooth_modes.h"
#include "native/reflection/features.h"
#include "native/reflection/scalar_gradient.h"

namespace reflines {
namespace {

// A free border leaves the profile along the lines undetermined (theta ~ f_x: any g(y) is free; null space 9 on a free
// 8 x 8 grid). A second family across the first, asked to stay as it is, leaves only affine functions; the proximity
// holds those. Of the two, the second family is blind to position and bends nothing, so it may be the stronger one.
constexpr double kCrossingWeight = 1e-3;
// Measured with a clean panel as target for a rippled one, free on all sides: with 1e-6 it tilts by 7 times the ripples
// (the lines hardly see it), with 10 by 1 %, and up to 1000 the lines come out the same.
constexpr double kFreeBorderProximity = 10.0;

// Of cages, always: a vertex may move no sample that counts (weight 0, hidden lines), and then the Hessian is singular.
// Where all samples count, its smallest eigenvalue is 3 to 200 and the pull adds 1e-7 to it.
constexpr double kCageProximity = 1e-6;

// Mean vertex distances between the knots of the coarse motions.
constexpr double kKnotSpacing = 6.0;

// Creases that a cage moves are no border: the heights of both sides are one.
bool has_free_border(const HeightField& field) {
  const Triangles neighbors = edge_neighbors(field.F);
  for (int t = 0; t < field.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (neighbors(t, i) >= 0) continue;
      for (int j = 1; j < 3; ++j) {
        if (field.role[field.F(t, (i + j) % 3)] == VertexRole::kFree) return true;
      }
    }
  }
  return false;
}

double default_proximity(double proximity, bool free_border, bool cage) {
  if (proximity >= 0) return proximity;
  if (free_border) return kFreeBorderProximity;
  return cage ? kCageProximity : 0.0;
}

}  // namespace

PieceProblem::PieceProblem(Piece piece, Unknowns unknowns, StencilKind stencil,
                           std::vector<ReflectionFunction> families, double proximity, LinearSolverKind solver)
    : piece_(std::move(piece)),
      stencils_(make_stencils(piece_.field, stencil)),
      families_(std::move(families)),
      free_border_(has_free_border(piece_.field)),
      unknowns_(std::move(unknowns)),
      energy_(piece_.field, stencils_, default_proximity(proximity, free_border_, unknowns_.modes().size() > 0)),
      minimizer_(solver),
      solver_(solver),
      x_(unknowns_.start()),
      z_(piece_.field.z) {
  find_hidden();
}

void PieceProblem::find_hidden() {
  for (size_t k = 0; k < families_.size(); ++k) {
    visible_.push_back(field(static_cast<int>(k)).visibility.unaryExpr(&visibility_weight));
  }
  for (int t = 0; t < stencils_.triangle_count(); ++t) {
    bool hidden = false;
    for (size_t k = 0; k + 1 < families_.size(); ++k) hidden = hidden || visible_[k](t) < 1;
    hidden_count_ += hidden;
  }
}

void PieceProblem::set_heights(const Vector& x) {
  x_ = x;
  unknowns_.heights(x_, z_);
}

void PieceProblem::rest_at(const Vector& x) {
  set_heights(x);
  energy_.set_start(z_);
}

void PieceProblem::reset() {
  set_heights(unknowns_.start());
  // A kept factor makes the next solve 3 times faster at 100k, but its other path to the minimum ends 4e-9 beside it.
  minimizer_.emplace(solver_);
}

ReflectionField PieceProblem::field(int family) const {
  TriangleDerivatives u;
  apply_stencils(stencils_, z_, u);
  return reflection_field(families_[family], u);
}

void PieceProblem::add_vertex_field(RegionField& region) const {
  const HeightField& field = piece_.field;
  TriangleDerivatives u;
  apply_stencils(stencils_, z_, u);
  const ReflectionField own = reflection_field(families_[region.family], u);
  for (int t = 0; t < field.triangle_count(); ++t) region.area(field.source[t]) = field.area(t);
  for (int v = 0; v < field.vertex_count(); ++v) {
    Vector2 slope = Vector2::Zero(), gradient = Vector2::Zero();
    double area = 0;
    for (int k = field.triangles_of_vertex.begin(v); k < field.triangles_of_vertex.end(v); ++k) {
      const int t = field.triangles_of_vertex.items[k];
      slope += field.area(t) * slope_at(t, v, u);
      gradient += field.area(t) * own.gradient.row(t).transpose();
      area += field.area(t);
    }
    slope /= area;
    region.vertex_theta(piece_.vertex[v]) = families_[region.family].theta(slope.x(), slope.y());
    region.vertex_gradient.row(piece_.vertex[v]) = gradient.transpose() / area;
  }
}

// Slope at corner v of the quadratic that passes through t's corners and has t's Hessian.
Vector2 PieceProblem::slope_at(int t, int v, const TriangleDerivatives& u) const {
  const HeightField& field = piece_.field;
  const int i = field.F(t, 0) == v ? 0 : field.F(t, 1) == v ? 1 : 2;
  const Eigen::RowVector3i corners(v, field.F(t, (i + 1) % 3), field.F(t, (i + 2) % 3));
  const auto bend = [&](int other) {
    const Eigen::RowVector2d e = field.xy.row(other) - field.xy.row(v);
    return 0.5 * (u(t, 2) * e.x() * e.x() + u(t, 4) * e.y() * e.y()) + u(t, 3) * e.x() * e.y();
  };
  return Vector2(u(t, 0), u(t, 1)) - linear_gradient(field.xy, corners, bend(corners(1)), bend(corners(2)));
}

Vector PieceProblem::changeable_area() const {
  const HeightField& field = piece_.field;
  Vector area = field.area;
  for (int t = 0; t < field.triangle_count(); ++t) {
    bool changeable = false;
    for (int i = 0; i < 3; ++i) changeable = changeable || field.role[field.F(t, i)] == VertexRole::kFree;
    if (!changeable) area(t) = 0;
  }
  return area;
}

EnergyTerm PieceProblem::term(const Target& target) const {
  const HeightField& field = piece_.field;
  EnergyTerm term{families_[target.family], {}, {}, Vector(field.triangle_count())};
  const bool by_value = target.theta.size() > 0;
  term.gradient.resize(by_value ? 0 : field.triangle_count(), 2);
  term.theta.resize(by_value ? field.triangle_count() : 0);
  for (int t = 0; t < field.triangle_count(); ++t) {
    const int row = field.source[t];
    const double wanted_weight = target.weight.size() > 0 ? target.weight(row) : 1.0;
    term.weight(t) = wanted_weight * field.area(t) * visible_[target.family](t);
    if (by_value) {
      term.theta(t) = target.theta(row);
    } else {
      term.gradient.row(t) = target.gradient.row(row);
    }
  }
  return term;
}

ReflectionField PieceProblem::start_field(int family) const {
  TriangleDerivatives u;
  apply_stencils(stencils_, piece_.field.z, u);
  return reflection_field(families_[family], u);
}

EnergyTerm PieceProblem::crossing_term() const {
  const int last = static_cast<int>(families_.size()) - 1;
  return {families_[last],
          start_field(last).gradient,
          {},
          (kCrossingWeight * piece_.field.area.array() * visible_[last].array()).matrix()};
}

void PieceProblem::set_targets(const std::vector<Target>& targets) {
  std::vector<EnergyTerm> terms;
  for (const Target& target : targets) terms.push_back(term(target));
  if (free_border_) terms.push_back(crossing_term());
  energy_.set_terms(std::move(terms));
}

Report PieceProblem::minimize(const MinimizerOptions& options, Progress* progress) {
  Vector x = x_;
  const Report report = minimizer_->minimize(*this, x, options, progress);
  set_heights(x);
  return report;
}

const FieldSmoother& PieceProblem::kept(KeptSmoother& kept, const SmoothOptions& options, const PlaneVectors& along,
                                        int family) {
  const bool same_along = along.rows() == kept.along.rows() && along == kept.along;
  if (kept.smoother && kept.length == options.length && kept.family == family && same_along) return *kept.smoother;
  const SpdFactorize factorize = [this](const SparseMatrix& matrix) -> SpdSolve {
    auto solver = std::make_shared<LinearSolver>(solver_);
    solver->analyze(matrix);
    solver->factorize(matrix);
    return [solver](Vector& x) { solver->solve(x); };
  };
  kept = {std::make_unique<FieldSmoother>(piece_.field, stencils_, options, along, features(options.length, family),
                                          factorize),
          options.length, along, family};
  return *kept.smoother;
}

PlaneVectors PieceProblem::smoothed(const PlaneVectors& gradient, const SmoothOptions& options, int family) {
  const PlaneVectors isotropic = kept(isotropic_, {options.length, false}, PlaneVectors(0, 2), family).smooth(gradient);
  return options.directional ? kept(directional_, options, isotropic, family).smooth(gradient) : isotropic;
}

Mask PieceProblem::features(double length, int family) const {
  return strong_features(piece_.field, start_field(family).gradient, length);
}

double PieceProblem::evaluate(const Vector& x, Vector* gradient) {
  unknowns_.heights(x, trial_z_);
  if (!gradient) return energy_.evaluate(trial_z_, nullptr);
  const double energy = energy_.evaluate(trial_z_, &gradient_z_);
  unknowns_.pull_back(gradient_z_, *gradient);
  return energy;
}

const SparseMatrix& PieceProblem::hessian(const Vector& x, HessianModel model) {
  if (!assembly_) {
    assembly_ =
        std::make_unique<HessianAssembly>(stencils_, energy_.entries(), unknowns_.column(), unknowns_.moving_count());
    if (unknowns_.modes().size() > 0) product_ = std::make_unique<GalerkinProduct>(unknowns_.modes());
  }
  unknowns_.heights(x, trial_z_);
  const SparseMatrix& whole =
      assembly_->assemble(energy_.element_hessians(trial_z_, model), energy_.proximity_hessian());
  return product_ ? product_->project(whole) : whole;
}

const SparseMatrix* PieceProblem::smooth_modes() {
  if (unknowns_.modes().size() > 0) return nullptr;  // few unknowns: their own factor is cheap
  if (!smooth_modes_)
    smooth_modes_ = std::make_unique<SparseMatrix>(reflines::smooth_modes(piece_.field, kKnotSpacing));
  return smooth_modes_.get();
}

}  // namespace reflines
