#include "native/piece_problem.h"

#include <algorithm>
#include <limits>

#include "native/coarse_piece.h"
#include "native/geometry/smooth_modes.h"
#include "native/optimization/dissection.h"
#include "native/reflection/features.h"
#include "native/reflection/scalar_gradient.h"

namespace reflines {
namespace {

// Of free borders, where the lines leave affine functions open (see crossing_term). Measured with a clean panel as
// target for a rippled one, free on all sides: with 1e-6 it tilts by 7 times the ripples (the lines hardly see it),
// with 10 by 1 %, and up to 1000 the lines come out the same.
constexpr double kFreeBorderProximity = 10.0;

// Of cages, always: a vertex may move no sample that counts (weight 0, hidden lines), and then the Hessian is singular.
// Where all samples count, its smallest eigenvalue is 3 to 200 and the pull adds 1e-7 to it.
constexpr double kCageProximity = 1e-6;

// Times the gradient of a strong bend: longer ones, and longer changes, are not believed in smoothing. Of 1, 4 and all
// on 25 careless selections of a car body 4 moves the least and leaves the least wobble (a roof with its rails, faces
// up to 70 degrees from the view: 131 mm with all, 9 mm with 4); dents of 2 mm in 8 cm stay well below.
constexpr double kOutlier = 4.0;

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

std::vector<int> sampled_triangles(const HeightField& field, const Vector& share) {
  std::vector<int> sampled;
  for (int t = 0; t < field.triangle_count() && share.size() > 0; ++t) {
    if (share(field.source[t]) > 0) sampled.push_back(t);
  }
  return sampled;
}

Vector shares_of(const HeightField& field, const std::vector<int>& sampled, const Vector& share) {
  Vector result(sampled.size());
  for (int k = 0; k < result.size(); ++k) result(k) = share(field.source[sampled[k]]);
  return result;
}

}  // namespace

PieceProblem::PieceProblem(Piece piece, Unknowns unknowns, StencilKind stencil,
                           std::vector<ReflectionFunction> families, double proximity, LinearSolverKind solver,
                           const Vector& share)
    : piece_(std::move(piece)),
      stencils_(make_stencils(piece_.field, stencil)),
      sampled_(sampled_triangles(piece_.field, share)),
      share_(shares_of(piece_.field, sampled_, share)),
      sampled_stencils_(chosen_stencils(stencils_, sampled_)),
      families_(std::move(families)),
      free_border_(has_free_border(piece_.field)),
      unknowns_(std::move(unknowns)),
      energy_(piece_.field, sampled_.empty() ? stencils_ : sampled_stencils_,
              default_proximity(proximity, free_border_, unknowns_.modes().size() > 0)),
      minimizer_(solver),
      solver_(solver),
      x_(unknowns_.start()),
      z_(piece_.field.z) {
  find_hidden();
}

void PieceProblem::find_hidden() {
  TriangleDerivatives u;
  apply_stencils(stencils_, z_, u);
  for (const ReflectionFunction& family : families_) visible_.push_back(visibility_weights(family, u));
  for (int t = 0; t < stencils_.triangle_count(); ++t) {
    bool hidden = false;
    for (size_t k = 0; k + 1 < families_.size(); ++k) hidden = hidden || visible_[k](t) < 1;
    hidden_count_ += hidden;
  }
  const Mask held = held_at_border(piece_.field);
  for (Vector& weight : visible_) weight = held.select(0.0, weight.array());
}

void PieceProblem::set_heights(const Vector& x) {
  x_ = x;
  unknowns_.heights(x_, z_);
  kept_field_.family = -1;
}

void PieceProblem::rest_at(const Vector& x) {
  set_heights(x);
  energy_.set_start(z_);
}

void PieceProblem::pull_to(const Vector& z, const Vector& weight) {
  energy_.pull_to(z, weight);
  pulled_ = true;
  minimizer_.emplace(solver_);  // its factor is of another energy
}

void PieceProblem::reset() {
  set_heights(unknowns_.start());
  energy_.pull_as_built(piece_.field.z);
  pulled_ = false;
  // A kept factor makes the next solve 3 times faster at 100k, but its other path to the minimum ends 4e-9 beside it.
  minimizer_.emplace(solver_);
}

ReflectionField PieceProblem::field_of(const Vector& z, int family) const {
  TriangleDerivatives u;
  apply_stencils(stencils_, z, u);
  return reflection_field(families_[family], u);
}

bool PieceProblem::depends_only_on(int triangle, const Vector& known) const {
  for (int e = stencils_.offset[triangle]; e < stencils_.offset[triangle + 1]; ++e) {
    if (!(known(stencils_.vertex[e]) > 0)) return false;
  }
  return true;
}

const ReflectionField& PieceProblem::field(int family) {
  if (kept_field_.family != family) kept_field_ = {family, field_of(z_, family)};
  return kept_field_.field;
}

void PieceProblem::add_vertex_field(RegionField& region) const {
  const HeightField& field = piece_.field;
  TriangleDerivatives u;
  apply_stencils(stencils_, z_, u);
  const ReflectionField own = reflection_field(families_[region.family], u);
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
    region.vertex_slope.row(piece_.vertex[v]) = slope.transpose();
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

Report PieceProblem::minimize(const MinimizerOptions& options, Progress* progress) {
  Vector x = x_;
  const Report report = minimizer_->minimize(*this, x, options, progress);
  set_heights(x);
  return report;
}

void PieceProblem::enter(double fraction, const char* stage) const {
  if (progress_ != nullptr) progress_->enter(fraction, stage);
}

const PlaneVectors& PieceProblem::KeptSmoother::of(const PlaneVectors& gradient) {
  if (rough.rows() == gradient.rows() && rough == gradient) return smooth;
  smooth = smoother->smooth(gradient);
  rough = gradient;
  return smooth;
}

PieceProblem::KeptSmoother& PieceProblem::kept(KeptSmoother& kept, const SmoothOptions& options,
                                               const PlaneVectors& along, int family) {
  const bool same_along = along.rows() == kept.along.rows() && along == kept.along;
  if (kept.smoother && kept.length == options.length && kept.family == family && same_along) return kept;
  const SpdFactorize factorize = [this](const SparseMatrix& matrix) -> SpdSolve {
    auto solver = std::make_shared<LinearSolver>(solver_);
    enter(0.3, "ordering the smoothing");
    solver->analyze(matrix, dissection_order(matrix, piece_.field.xy));
    enter(0.6, "factorizing the smoothing");
    solver->factorize(matrix);
    enter(0.9, "smoothing");
    return [solver](Vector& x) { solver->solve(x); };
  };
  enter(0.0, "finding features");
  const Mask& held = features(options.length, family);
  enter(0.1, "assembling the smoothing");
  SmoothOptions own = options;
  own.longest = longest(family);
  auto smoother =
      std::make_unique<FieldSmoother>(piece_.field, stencils_, own, along, visible_[family], held, factorize);
  kept = {std::move(smoother), options.length, along, family, {}, {}};
  return kept;
}

// A cage's surface has no thin triangles to read wrong: its dents bend as strongly as they look.
double PieceProblem::longest(int family) const {
  if (unknowns_.modes().size() > 0) return std::numeric_limits<double>::infinity();
  return kOutlier * strong_bend(field_of(piece_.field.z, family).gradient, piece_.field.diagonal());
}

PlaneVectors PieceProblem::smoothed(const PlaneVectors& gradient, const SmoothOptions& options, int family) {
  const PlaneVectors& isotropic = kept(isotropic_, {options.length, false}, PlaneVectors(0, 2), family).of(gradient);
  return options.directional ? kept(directional_, options, isotropic, family).of(gradient) : isotropic;
}

const Mask& PieceProblem::features(double length, int family) {
  if (kept_features_.family != family || kept_features_.length != length) {
    const PlaneVectors start = field_of(piece_.field.z, family).gradient;
    kept_features_ = {family, length, strong_features(piece_.field, start, length)};
  }
  return kept_features_.mask;
}

double PieceProblem::evaluate(const Vector& x, Vector* gradient) {
  unknowns_.heights(x, trial_z_);
  if (!gradient) return energy_.evaluate(trial_z_, nullptr);
  const double energy = energy_.evaluate(trial_z_, &gradient_z_);
  unknowns_.pull_back(gradient_z_, *gradient);
  return energy;
}

HessianAssembly& PieceProblem::assembly() {
  if (!assembly_) {
    assembly_ = std::make_unique<HessianAssembly>(energy_.stencils(), energy_.entries(), unknowns_.column(),
                                                  unknowns_.moving_count());
    if (unknowns_.modes().size() > 0) product_ = std::make_unique<GalerkinProduct>(unknowns_.modes());
  }
  return *assembly_;
}

const SparseMatrix* PieceProblem::pattern() { return unknowns_.modes().size() > 0 ? nullptr : &assembly().pattern(); }

const SparseMatrix& PieceProblem::hessian(const Vector& x, HessianModel model) {
  unknowns_.heights(x, trial_z_);
  const SparseMatrix& whole =
      assembly().assemble(energy_.element_hessians(trial_z_, model), energy_.proximity_hessian());
  if (!product_) return whole;
  height_rounding_ = whole.diagonal();
  return product_->project(whole);
}

// Heights of a fine surface are rounded as coarsely as those of its cage, but its second derivatives notice it far
// more.
Vector PieceProblem::rounding_weight(const SparseMatrix& hessian) {
  if (!product_) return hessian.diagonal();
  return (unknowns_.modes().cwiseAbs2() * height_rounding_.cwiseAbs2()).cwiseSqrt();
}

PlanePositions PieceProblem::places() {
  if (unknowns_.modes().size() > 0) return {};
  PlanePositions result(size(), 2);
  for (int v = 0; v < piece_.field.vertex_count(); ++v) {
    if (unknowns_.column()[v] >= 0) result.row(unknowns_.column()[v]) = piece_.field.xy.row(v);
  }
  return result;
}

std::unique_ptr<CoarseProblem> PieceProblem::coarse(const Vector& x, const Vector& gradient) {
  // Few unknowns: their own factor is cheap. Few triangles that count: the samples would be of samples.
  if (unknowns_.modes().size() > 0 || !sampled_.empty()) return nullptr;
  SmoothModes modes = smooth_modes(piece_.field, kKnotSpacing);
  if (modes.count == 0) return nullptr;
  unknowns_.heights(x, trial_z_);
  return std::make_unique<CoarsePiece>(piece_.field, energy_, std::move(modes), trial_z_, gradient);
}

}  // namespace reflines
