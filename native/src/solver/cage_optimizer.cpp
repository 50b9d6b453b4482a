#include "reflines/cage_optimizer.h"

#include <cmath>
#include <numbers>
#include <string>

#include "optimization/linear/linear_solver.h"
#include "optimization/row_limits.h"
#include "reflines/errors.h"
#include "solver/cage_surface.h"
#include "solver/optimizer_internals.h"

namespace reflines {
namespace {

// The pull, relative to the largest diagonal entry, of cage vertices that no fitted height depends on.
constexpr double kUnseen = 1e-9;

// The wavelength, in faces of the cage, above which shapes follow the fitted heights, and below which the lines. By
// lines alone the clean cage of a bonnet drifted by 0.7 mm from the position that the heights, wrong by 0.01 mm, had
// given it.
constexpr double kHeightsRule = 4.0;

ShapeOptions make_shape_options(const CageSurface& surface, const IndexVector& image_of, ShapeOptions shape) {
  shape.border = surface.border;
  shape.around = surface.around;
  shape.held.resize(0);
  shape.partner.resize(0);
  shape.B = surface.S * surface.B;
  shape.start = surface.start;
  shape.quadrature_weight = surface.quadrature_weight;
  shape.face_of_triangle = surface.parent;
  if (image_of.size() > 0) shape.face_of_triangle = image_of(surface.parent);
  return shape;
}

void check_fit(const Vector& heights, const Vector& weight, Eigen::Index vertices) {
  if (heights.size() != vertices || weight.size() != vertices) {
    throw InvalidInput("There are " + std::to_string(heights.size()) + " heights and " + std::to_string(weight.size()) +
                       " weights to fit; the surface has " + std::to_string(vertices) + " vertices.");
  }
  Eigen::Index bad = 0;
  for (Eigen::Index v = 0; v < vertices; ++v) {
    const bool usable = weight(v) >= 0 && std::isfinite(weight(v)) && (weight(v) == 0 || std::isfinite(heights(v)));
    bad += !usable;
  }
  if (bad == 0) return;
  throw InvalidInput(std::to_string(bad) + " of the " + std::to_string(vertices) +
                     " heights to fit or their weights are not finite or a weight is negative; give those weight 0.");
}

}  // namespace

CageOptimizer::CageOptimizer(const Cage& cage, const Positions& V, const Vector3& view_direction,
                             const std::vector<Vector3>& line_directions, const CageOptions& options)
    : V_(V),
      cage_surface_(std::make_unique<const CageSurface>(make_cage_surface(cage, V, view_direction, options))),
      surface_optimizer_(cage_surface_->positions, cage_surface_->F, view_direction, line_directions,
                         make_shape_options(*cage_surface_, options.image_of, options.shape)) {}

CageOptimizer::~CageOptimizer() = default;

Region CageOptimizer::region() const {
  Region region = surface().region();
  region.free = static_cast<int>(cage_free().count());
  region.fixed = static_cast<int>(V_.rows()) - region.free;
  region.clamped = 0;
  return region;
}

const Triangles& CageOptimizer::triangles() const { return cage_surface_->F; }

const IndexVector& CageOptimizer::parent() const { return cage_surface_->parent; }

const IndexVector& CageOptimizer::refined() const { return cage_surface_->refined; }

const SparseMatrix& CageOptimizer::influence() const { return cage_surface_->S; }

Mask CageOptimizer::cage_free() const {
  Mask result = Mask::Constant(V_.rows(), false);
  for (const int k : surface().internals().free_unknowns) {
    for (SparseMatrix::InnerIterator it(cage_surface_->B, k); it; ++it) result(it.row()) = true;
  }
  return result;
}

Positions CageOptimizer::cage_positions() const {
  Positions result = V_;
  const std::vector<int>& free = surface().internals().free_unknowns;
  for (size_t j = 0; j < free.size(); ++j) {
    const double move = surface().internals().unknowns()(static_cast<int>(j)) - cage_surface_->start(free[j]);
    if (move == 0) continue;
    for (SparseMatrix::InnerIterator it(cage_surface_->B, free[j]); it; ++it) {
      result.row(it.row()) += move * surface().frame().z().transpose();
    }
  }
  return result;
}

void CageOptimizer::fit(const Vector& heights, const Vector& weight) {
  check_fit(heights, weight, cage_surface_->S.rows());
  ShapeOptimizer::Internals& own = surface().internals();
  const int n = static_cast<int>(own.free_unknowns.size());
  const SparseMatrix all = cage_surface_->S * cage_surface_->B;
  const SparseMatrix B = select_columns(all, own.free_unknowns);
  const SparseMatrix WB = weight.asDiagonal() * B;
  SparseMatrix identity(n, n);
  identity.setIdentity();
  const SparseMatrix normal = B.transpose() * WB;
  const double seen = normal.diagonal().maxCoeff();
  if (seen == 0) return;
  const SparseMatrix lower = SparseMatrix(normal + kUnseen * seen * identity).triangularView<Eigen::Lower>();
  const Vector missing = (weight.array() > 0).select(heights - surface().heights(), 0.0);
  Vector step = WB.transpose() * missing;
  LinearSolver solver(LinearSolverKind::kCholmod);
  solver.analyze(lower);
  solver.factorize(lower);
  solver.solve(step);
  own.rest_at(own.unknowns() + step);
  own.pull_to(heights, height_density() * weight);
}

// Returns the weight of the pull to fitted heights, per area: with theta ~ 2 f_x a wave of height h and number k costs
// 4 k^4 h^2 where its lines are wrong.
double CageOptimizer::height_density() {
  const int faces = 1 + static_cast<int>((cage_surface_->parent.tail(cage_surface_->parent.size() - 1).array() !=
                                          cage_surface_->parent.head(cage_surface_->parent.size() - 1).array())
                                             .count());
  const double face = std::sqrt(surface().region_field(0).area.sum() / faces);
  return 4 * std::pow(2 * std::numbers::pi / (kHeightsRule * face), 4);
}

}  // namespace reflines
