#include "solver/piece_problem.h"

#include <algorithm>

#include "reflection/scalar_gradient.h"
#include "solver/coarse/coarse_piece.h"
#include "solver/coarse/spline_basis.h"

namespace reflines {
namespace {

// The default proximity with a free border, where the lines leave affine functions open (see
// TargetTerms::build_crossing): a rippled panel, free on all sides, tilts by 1 % of the ripples.
constexpr double kFreeBorderProximity = 10.0;

// The default proximity of cages: a vertex may move no sample that counts (weight 0, hidden lines), and then the
// Hessian is singular. Where all samples count, its smallest eigenvalue is 3 to 200 and the pull adds 1e-7 to it.
constexpr double kCageProximity = 1e-6;

// The spacing of the coarse problem's knots in mean vertex distances.
constexpr double kKnotSpacing = 6.0;

// Returns whether some border vertex is free. Creases that a cage moves are no border: the heights of both sides are
// one.
bool has_free_border(const HeightField& field) {
  const Mask border = find_border_vertices(field.F, field.vertex_count());
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (border(v) && field.role[v] == VertexRole::kFree) return true;
  }
  return false;
}

double default_proximity(double proximity, bool free_border, SurfaceKind kind) {
  if (proximity >= 0) return proximity;
  if (free_border) return kFreeBorderProximity;
  return kind == SurfaceKind::kSubdivided ? kCageProximity : 0.0;
}

}  // namespace

PieceProblem::PieceProblem(Piece piece, AffineMap map, SurfaceKind kind, StencilKind stencil, const Families& families,
                           double proximity, LinearSolverKind solver, const Vector& quadrature_weight)
    : piece_(std::move(piece)),
      stencils_(make_stencils(piece_.field, stencil)),
      quadrature_(make_quadrature(piece_.field, quadrature_weight)),
      sampled_stencils_(select_stencils(stencils_, quadrature_.triangle)),
      families_(families.lines),
      free_border_(has_free_border(piece_.field)),
      map_(std::move(map)),
      kind_(kind),
      energy_(piece_.field, quadrature_.is_sampled() ? sampled_stencils_ : stencils_,
              default_proximity(proximity, free_border_, kind)),
      has_eyes_(!families.sight.empty()),
      terms_(piece_.field, quadrature_, families_, visible_, energy_.stencils().triangle_count()),
      minimizer_(solver),
      solver_(solver),
      // The surface of a cage has no thin triangles with wrong gradients: its dents bend as strongly as they appear.
      smoother_(piece_.field, stencils_, families_, visible_, kind == SurfaceKind::kMesh, solver),
      lines_(families_.size()),
      x_(map_.start()),
      z_(piece_.field.z) {
  find_hidden(families.sight);
}

void PieceProblem::find_hidden(const std::vector<Vector>& sight) {
  TriangleDerivatives u;
  apply_stencils(stencils_, z_, u);
  for (const ReflectionFunction& family : families_) visible_.push_back(visibility_weights(family, u));
  hidden_ = Mask::Constant(stencils_.triangle_count(), false);
  for (size_t k = 0; k + 1 < families_.size(); ++k) hidden_ = hidden_ || visible_[k].array() < 1;
  for (size_t k = 0; k < sight.size(); ++k)
    visible_[k] = visible_[k].cwiseProduct(sight[k](piece_.field.source)).eval();
  const Mask held = held_at_border(piece_.field);
  for (Vector& weight : visible_) weight = held.select(0.0, weight.array());
}

void PieceProblem::set_heights(const Vector& x) {
  x_ = x;
  if (x_ == map_.start())
    z_ = piece_.field.z;  // without the rounding of B x + c
  else
    map_.apply(x_, z_);
  if (!is_mesh()) largest_move_ = (z_ - piece_.field.z).cwiseAbs().maxCoeff();
  lines_.assign(families_.size(), std::nullopt);
}

void PieceProblem::rest_at(const Vector& x) {
  set_heights(x);
  energy_.set_start(z_);
}

void PieceProblem::pull_to(const Vector& z, const Vector& weight) {
  energy_.pull_to(z, weight);
  pulled_ = true;
  minimizer_.emplace(solver_);  // its factor belongs to another energy
}

void PieceProblem::scale_move(double fraction) { set_heights(map_.start() + fraction * (x_ - map_.start())); }

void PieceProblem::set_move(const Vector& move) {
  Vector sum = Vector::Zero(size()), count = Vector::Zero(size());
  for (int v = 0; v < move.size(); ++v) {
    const int k = map_.moving_index()[v];
    if (k < 0) continue;
    sum(k) += move(v);
    count(k) += 1;
  }
  set_heights(map_.start() + sum.cwiseQuotient(count));
}

void PieceProblem::reset() {
  set_heights(map_.start());
  energy_.pull_as_built(piece_.field.z);
  pulled_ = false;
  // Without the kept factor, which would make the next solve 3 times faster at 100k, but whose other path to the
  // minimum ends 4e-9 beside it.
  minimizer_.emplace(solver_);
}

ReflectionField PieceProblem::evaluate_lines(const Vector& z, int family) const {
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

const ReflectionField& PieceProblem::lines(int family) {
  if (!lines_[family]) lines_[family] = evaluate_lines(z_, family);
  return *lines_[family];
}

void PieceProblem::add_vertex_field(RegionField& region) const {
  const HeightField& field = piece_.field;
  TriangleDerivatives u;
  apply_stencils(stencils_, z_, u);
  const PlaneVectors own = gradient_field(families_[region.family], u);
#pragma omp parallel for schedule(static) if (field.vertex_count() > kWorthThreads)
  for (int v = 0; v < field.vertex_count(); ++v) {
    Vector2 slope = Vector2::Zero(), gradient = Vector2::Zero();
    double area = 0;
    for (int k = field.triangles_of_vertex.begin(v); k < field.triangles_of_vertex.end(v); ++k) {
      const int t = field.triangles_of_vertex.items[k];
      slope += field.area(t) * slope_at(t, v, u);
      gradient += field.area(t) * own.row(t).transpose();
      area += field.area(t);
    }
    slope /= area;
    region.vertex_slope.row(piece_.vertex[v]) = slope.transpose();
    region.vertex_theta(piece_.vertex[v]) = families_[region.family].theta(slope.x(), slope.y());
    region.vertex_gradient.row(piece_.vertex[v]) = gradient.transpose() / area;
  }
}

// Returns the slope at corner v of the quadratic that passes through t's corners and has t's Hessian.
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

Mask PieceProblem::changeable() const {
  Mask result(piece_.field.triangle_count());
  for (int t = 0; t < result.size(); ++t) result(t) = piece_.field.has_free_vertex(t);
  return result;
}

void PieceProblem::set_targets(const std::vector<Target>& targets) {
  std::vector<EnergyTerm> terms = terms_.build(targets);
  const int crossing = static_cast<int>(families_.size()) - 1;
  const bool open = free_border_ && !pulled_;
  const Vector fraction = open ? Vector::Ones(stencils_.triangle_count()) : find_unseen(targets);
  if (open || fraction.maxCoeff() > 0)
    terms.push_back(terms_.build_crossing(evaluate_lines(piece_.field.z, crossing).gradient, fraction));
  energy_.set_terms(std::move(terms));
  evaluated_ = false;
}

// Returns how far each triangle (#T) is unseen by the eyes of all targets, 0 to 1: their lines leave it open.
Vector PieceProblem::find_unseen(const std::vector<Target>& targets) const {
  Vector seen = Vector::Zero(stencils_.triangle_count());
  if (!has_eyes_) return seen;
  for (const Target& target : targets) seen = seen.cwiseMax(visible_[target.family]);
  return (visible_.back().array() > 0).select(1.0 - seen.array(), 0.0);  // of held triangles nothing is open
}

double PieceProblem::energy() {
  evaluated_ = false;
  return energy_.evaluate(z_, nullptr);
}

TargetTerms::Misfit PieceProblem::misfit(const std::vector<Target>& targets, bool set) const {
  if (set && evaluated_ && energy_.only_term() && targets.front().theta.size() == 0 && trial_z_ == z_)
    return terms_.measure_evaluated(targets.front(), energy_, z_);
  TriangleDerivatives u;
  apply_stencils(energy_.stencils(), z_, u);
  return terms_.measure(targets, u);
}

Report PieceProblem::minimize(const MinimizerOptions& options, Progress* progress) {
  Vector x = x_;
  const Report report = limit_.exists() ? minimizer_->minimize(*this, limits(), x, options, progress)
                                        : minimizer_->minimize(*this, x, options, progress);
  set_heights(x);
  return report;
}

const FieldAverage& PieceProblem::average() {
  if (!average_) average_.emplace(piece_.field);
  return *average_;
}

double PieceProblem::evaluate(const Vector& x, Vector* gradient) {
  map_.apply(x, trial_z_);
  evaluated_ = true;
  if (!gradient) return energy_.evaluate(trial_z_, nullptr);
  const double energy = energy_.evaluate(trial_z_, &gradient_z_);
  map_.pull_back(gradient_z_, *gradient);
  return energy;
}

HessianAssembly& PieceProblem::assembly() {
  if (!assembly_) {
    assembly_ = std::make_unique<HessianAssembly>(energy_.stencils(), energy_.entries(), map_.moving_index(),
                                                  map_.moving_count());
    if (!map_.is_selection()) product_ = std::make_unique<GalerkinProduct>(map_.moving_transposed());
  }
  return *assembly_;
}

const SparseMatrix* PieceProblem::pattern() { return !map_.is_selection() ? nullptr : &assembly().pattern(); }

const SparseMatrix& PieceProblem::hessian(const Vector& x, HessianModel model) {
  evaluated_ = false;
  map_.apply(x, trial_z_);
  const SparseMatrix& whole =
      assembly().assemble(energy_.element_hessians(trial_z_, model), energy_.proximity_hessian());
  if (!product_) return whole;
  height_rounding_ = whole.diagonal();
  return product_->project(whole);
}

// Heights of a fine surface are rounded as coarsely as those of its cage, but its second derivatives are far more
// sensitive to it.
Vector PieceProblem::rounding_weight(const SparseMatrix& hessian) {
  if (!product_) return hessian.diagonal();
  return (map_.moving_transposed().cwiseAbs2() * height_rounding_.cwiseAbs2()).cwiseSqrt();
}

PlanePositions PieceProblem::places() {
  if (!map_.is_selection()) return {};
  return piece_.field.xy(map_.leaders(), Eigen::all);
}

// Returns the places of the vertices that move with the unknowns' own, those where there is none; nothing where there
// are none at all.
PlanePositions PieceProblem::image_places() {
  if (!map_.has_followers()) return {};
  PlanePositions result = places();
  for (int v = 0; v < piece_.field.vertex_count(); ++v) {
    const int k = map_.moving_index()[v];
    if (k >= 0 && map_.leaders()[k] != v) result.row(k) = piece_.field.xy.row(v);
  }
  return result;
}

std::unique_ptr<CoarseProblem> PieceProblem::coarse(const Vector& x, const Vector& gradient) {
  // There is no coarse problem of a cage, whose few unknowns have a cheap factor, nor of a sampled energy, which would
  // be sampled twice.
  if (!map_.is_selection() || quadrature_.is_sampled()) return nullptr;
  SplineBasis modes = build_spline_basis(piece_.field, kKnotSpacing);
  if (modes.count == 0) return nullptr;
  modes.places = places();
  modes.images = image_places();
  evaluated_ = false;
  map_.apply(x, trial_z_);
  return std::make_unique<CoarsePiece>(piece_.field, energy_, std::move(modes), trial_z_, gradient);
}

}  // namespace reflines
