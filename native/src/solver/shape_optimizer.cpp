#include "reflines/shape_optimizer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "geometry/bounding_box.h"
#include "geometry/mesh.h"
#include "optimization/linear/linear_solver.h"
#include "optimization/report_sums.h"
#include "reflection/line_comparison.h"
#include "reflines/errors.h"
#include "solver/border_curvature.h"
#include "solver/coupling.h"
#include "solver/limited_move.h"
#include "solver/mirror_coupling.h"
#include "solver/optimizer_internals.h"
#include "solver/reachable_target.h"
#include "solver/region_report.h"
#include "solver/solve_checks.h"
#include "solver/thread_limit.h"

namespace reflines {
namespace {

SurfaceKind find_kind(const ShapeOptions& options) {
  return options.B.rows() > 0 ? SurfaceKind::kSubdivided : SurfaceKind::kMesh;
}

void check_symmetry(const ShapeOptions& options, Eigen::Index vertex_count) {
  check_partners(options.partner, vertex_count);
  if (options.partner.size() == 0 || options.B.rows() == 0) return;
  throw InvalidInput("Mirror partners are given for the vertices of a cage's surface; give those of the cage.");
}

Boundary boundary_of(const ShapeOptions& options, Eigen::Index vertex_count) {
  Boundary boundary{options.border, options.held, options.creases, find_kind(options) == SurfaceKind::kMesh};
  if (boundary.border.empty()) boundary.border.assign(vertex_count, Border::kClamped);
  if (static_cast<Eigen::Index>(boundary.border.size()) != vertex_count ||
      (boundary.held.size() > 0 && boundary.held.size() != vertex_count)) {
    throw InvalidInput("The border codes and the held mask need one entry for each of the " +
                       std::to_string(vertex_count) + " vertices.");
  }
  hold_partners(options.partner, boundary);
  return boundary;
}

// Returns the boundary by which vertices are held: of a cage's surface the unknowns tell, and the border only how lines
// run on.
Boundary choose_roles(Boundary boundary, SurfaceKind kind) {
  if (kind == SurfaceKind::kSubdivided) boundary.border.assign(boundary.border.size(), Border::kFree);
  return boundary;
}

// Leaves what alternates between triangles out of a field of them: a mesh of flat facets has it on a fair surface, too.
// One average keeps r of a wave, and this 1 - (1 - r)^3.
PlaneVectors remove_facets(const PlaneVectors& off, const FieldAverage& average, const Mask& counts) {
  const PlaneVectors once = average.of(off, counts), twice = average.of(once, counts);
  return 3.0 * (once - twice) + average.of(twice, counts);
}

}  // namespace

ShapeOptimizer::ShapeOptimizer(const Positions& V, const Triangles& F, const Vector3& view_direction,
                               const std::vector<Vector3>& line_directions, const ShapeOptions& options)
    : own_(std::make_unique<Internals>(V, F, view_direction, line_directions, options)) {}

ShapeOptimizer::Internals::Internals(const Positions& V, const Triangles& F, const Vector3& view_direction,
                                     const std::vector<Vector3>& line_directions, const ShapeOptions& options)
    : pieces(V, F, choose_frame(view_direction, line_directions, options.eyes)),
      partner(options.partner),
      kind(find_kind(options)),
      family_count(static_cast<int>(line_directions.size())),
      linear_solver(options.linear_solver),
      progress(options.progress),
      face_of_triangle(options.face_of_triangle) {
  enter(0.0, "checking the mesh");
  check_surface(V, F);
  check_quadrature_weight(options.quadrature_weight, F.rows());
  check_face_of_triangle(face_of_triangle, F.rows());
  check_marked_creases(options.creases.marked, V.rows());
  check_proximity(options.proximity);
  check_symmetry(options, V.rows());
  box = find_bounding_box(V, F);
  enter(0.2, "dividing into height fields");
  const Boundary boundary = boundary_of(options, V.rows());
  HeightField field = make_height_field(V, F, pieces.frame(), choose_roles(boundary, kind));
  sampled = options.quadrature_weight.size() > 0;
  hold_partners(partner, field);
  if (kind == SurfaceKind::kSubdivided) free_unknowns = couple_vertices(options.B, options.start, field);
  const Families families = make_families(V, F, pieces.frame(), line_directions, options.eyes);
  if (see_nothing(families)) {
    throw InvalidInput(
        "No eye direction sees the region: it is turned away from all of them, seen at a grazing angle or hidden; turn "
        "one of them.");
  }
  sight = families.sight;
  region = describe_region(field, face_of_triangle, boundary.hold_creases);
  feature_length = kFeatureLength * field.diagonal();
  for (Piece& piece : split_pieces(field, partner)) {
    enter(0.6, "making stencils");
    if (piece.free_count == 0) region.unused_pieces += piece.field.piece_count;
    AffineMap map = make_affine_map(options.B, options.start, free_unknowns, piece);
    auto problem = std::make_unique<PieceProblem>(std::move(piece), std::move(map), kind, options.stencil, families,
                                                  options.proximity, options.linear_solver, options.quadrature_weight);
    problem->watch(progress.get());
    pieces.add(std::move(problem));
  }
  continue_border(field, boundary, options.around, families);
  if (region.free == 0) {
    const int faces = count_faces(Mask::Constant(pieces.triangle_count(), true));
    throw InvalidInput(explain_no_free_vertex(region, faces, count_doubled_vertices(V)));
  }
  region.hidden = count_faces(pieces.hidden());
  count_features(feature_length, 0);
  add_piece_notes(region);
  add_eye_notes(sight, region);
}

void ShapeOptimizer::Internals::continue_border(const HeightField& field, const Boundary& boundary,
                                                const Surroundings& around, const Families& families) {
  if (std::none_of(boundary.border.begin(), boundary.border.end(), continues_lines)) return;
  BorderCurvature curvature;
  if (around.exist()) {
    check_surroundings(around, pieces.vertex_count());
    std::vector<StartLines> start;
    for (const int family : {0, family_count}) {
      const PlaneVectors gradient = pieces.start_field(family);
      start.push_back({gradient, pieces.strong_size(gradient)});
    }
    curvature = continue_curvature(pieces.start(), field, boundary.border, around, pieces.frame(), boundary.creases,
                                   start, families.lines);
  }
  border = std::move(curvature.targets);
  if (border.empty() && curvature.strong == 0) {
    region.notes.push_back({NoteKind::kCurvatureUnknown});
  } else if (curvature.unknown > 0) {
    region.notes.push_back({NoteKind::kCurvaturePartlyUnknown, curvature.unknown});
  }
  if (curvature.strong > 0) region.notes.push_back({NoteKind::kStrongBorderBend, curvature.strong});
  if (curvature.constant > 0) region.notes.push_back({NoteKind::kFlowUnknown, curvature.constant});
}

std::vector<Target> ShapeOptimizer::Internals::with_border(const std::vector<Target>& targets) const {
  std::vector<Target> all = targets;
  all.insert(all.end(), border.begin(), border.end());
  return all;
}

ShapeOptimizer::~ShapeOptimizer() = default;

void ShapeOptimizer::watch(std::shared_ptr<Progress> progress) {
  own_->progress = std::move(progress);
  for (const auto& piece : own_->pieces.pieces()) piece->watch(own_->progress.get());
}

int ShapeOptimizer::Internals::count_faces(const Mask& triangles) const {
  return reflines::count_faces(triangles, face_of_triangle);
}

void ShapeOptimizer::Internals::enter(double fraction, const char* stage) const {
  if (progress) progress->enter(fraction, stage);
}

void ShapeOptimizer::Internals::check_family(int family) const {
  if (family >= 0 && family < family_count) return;
  throw InvalidInput("There is no family " + std::to_string(family) + " of light lines; there are " +
                     std::to_string(family_count) + ", counted from 0.");
}

void ShapeOptimizer::Internals::check(const Target& target) const {
  const bool by_value = target.theta.size() > 0;
  const Eigen::Index rows = by_value ? target.theta.size() : target.gradient.rows();
  check_family(target.family);
  if (rows != pieces.triangle_count() ||
      (target.weight.size() > 0 && target.weight.size() != pieces.triangle_count())) {
    throw InvalidInput("The target has " + std::to_string(rows) + " rows and " + std::to_string(target.weight.size()) +
                       " weights; it needs one for each of the " + std::to_string(pieces.triangle_count()) +
                       " triangles.");
  }
  const bool finite = by_value ? target.theta.allFinite() : target.gradient.allFinite();
  if (!finite || !target.weight.allFinite() || (target.weight.size() > 0 && target.weight.minCoeff() < 0)) {
    throw InvalidInput("The target has a value that is not finite, or a negative weight.");
  }
}

double ShapeOptimizer::energy(const std::vector<Target>& targets) {
  for (const Target& target : targets) own_->check(target);
  const std::vector<Target> all = own_->with_border(targets);
  double sum = 0;
  for (const auto& piece : own_->pieces.pieces()) {
    if (piece->size() == 0) continue;  // as solves do
    piece->set_targets(all);
    sum += piece->energy();
  }
  return sum;
}

Vector ShapeOptimizer::residual(const Target& target) const {
  own_->check(target);
  if (target.theta.size() > 0) {
    const Vector difference = theta(target.family) - target.theta;
    return difference.unaryExpr([](double d) { return std::abs(wrap_angle(d)); });
  }
  return ((field(target.family) - target.gradient).rowwise().norm().array() * active().cast<double>()).matrix();
}

void ShapeOptimizer::Internals::count_features(double length, int family) {
  set_feature_count(count_faces(pieces.features(family, length)), region);
}

FieldSmoother ShapeOptimizer::smoother(int family) {
  own_->check_family(family);
  return [this, family](const SmoothOptions& options) {
    own_->count_features(options.length, family);
    return own_->pieces.smooth_field(options, family);
  };
}

SpdFactorize ShapeOptimizer::factorizer() const {
  return [kind = own_->linear_solver](const SparseMatrix& matrix) -> SpdSolve {
    auto solver = std::make_shared<LinearSolver>(kind);
    solver->analyze(matrix);
    solver->factorize(matrix);
    return [solver](Vector& x) { solver->solve(x); };
  };
}

LineScore ShapeOptimizer::score(double length, int family) {
  const PlaneVectors field = this->field(family);
  if (!(length > 0) || !std::isfinite(length))
    throw InvalidInput("The length of the score must be a positive length in scene units.");
  LineSums sums;
  for (const auto& piece : own_->pieces.pieces()) {
    if (piece->size() == 0) continue;
    const Vector weight =
        piece->changeable().select(piece->field().area.cwiseProduct(piece->visible(family)).array(), 0.0);
    const PlaneVectors own = field(piece->triangles(), Eigen::all);
    const PlaneVectors course = piece->smoother().smooth_all(own, length, family);
    const PlaneVectors off = remove_facets(own - course, piece->average(), weight.array() > 0);
    sums += compare_lines(course + off, course, weight, length);
  }
  return sums.score();
}

void ShapeOptimizer::Internals::measure(const std::vector<Target>& targets, Report& report) const {
  double squared = 0, area = 0;
  for (const auto& piece : pieces.pieces()) {
    for (int v = 0; v < piece->field().vertex_count(); ++v) {
      const double move = std::abs(piece->move(v));
      report.largest_move = std::max(report.largest_move, std::isfinite(move) ? move : INFINITY);
    }
    const TargetTerms::Misfit own = piece->misfit(targets, report.termination != Termination::kCancelled);
    squared += own.squared;
    area += own.area;
  }
  report.residual_rms = area > 0 ? std::sqrt(squared / area) : 0.0;
}

Report ShapeOptimizer::solve(const std::vector<Target>& targets, const MinimizerOptions& options, Progress* progress,
                             const MoveLimit& limit) {
  const ThreadLimit few(own_->sampled ? 1 : 0);
  if (targets.empty()) throw InvalidInput("There is no target to solve for; give at least one.");
  for (const Target& target : targets) own_->check(target);
  if (limit.exists()) reflines::check(limit, own_->pieces.vertex_count());
  const Internals::State before = own_->state();
  const auto restore = [&](bool factors_are_kept) {
    own_->restore(before);
    for (const auto& piece : own_->pieces.pieces()) {
      if (!factors_are_kept) piece->forget_factor();
    }
  };
  own_->pieces.set_limit(limit.exists() && is_infinite(limit) ? MoveLimit::none()
                                                              : intersect_limits(limit, own_->partner));
  own_->forget_lines();
  const std::vector<Target> joined = own_->border.empty() ? std::vector<Target>() : own_->with_border(targets);
  const std::vector<Target>& all = own_->border.empty() ? targets : joined;
  std::vector<Target> reachable;
  Report report;
  report.strategy = options.strategy;
  report.termination = Termination::kAlreadyOptimal;
  try {
    for (const auto& piece : own_->pieces.pieces()) {
      if (piece->size() == 0) continue;
      const Report own = minimize_reachable(*piece, all, reachable, options, progress);
      if (report.unknowns == 0)
        report = own;
      else
        add_piece_report(own, report);
      if (own.termination == Termination::kCancelled) break;
    }
    if (report.termination == Termination::kCancelled) restore(report.assemblies == 0 && report.solves == 0);
    own_->measure(targets, report);
    check_move_size(own_->box, report.largest_move);
    own_->tell_limit(report);
  } catch (...) {
    restore(false);
    throw;
  }
  return report;
}

SparseMatrix ShapeOptimizer::Internals::hessian(const std::vector<Target>& targets, HessianModel model) {
  for (const Target& target : targets) check(target);
  const std::vector<Target> all = with_border(targets);
  int size = 0;
  for (const auto& piece : pieces.pieces()) size += piece->size();
  SparseMatrix result(size, size);
  int first = 0;
  for (const auto& piece : pieces.pieces()) {
    if (piece->size() == 0) continue;
    piece->set_targets(all);
    const SparseMatrix& own = piece->hessian(piece->unknowns(), model);
    result.reserve(result.nonZeros() + own.nonZeros());
    for (int column = 0; column < own.cols(); ++column) {
      result.startVec(first + column);
      for (SparseMatrix::InnerIterator entry(own, column); entry; ++entry) {
        result.insertBack(first + static_cast<int>(entry.row()), first + column) = entry.value();
      }
    }
    first += piece->size();
  }
  result.finalize();
  return result;
}

void ShapeOptimizer::scale_move(double fraction) {
  if (!(fraction >= 0 && fraction <= 1)) throw InvalidInput("The share of the move must lie between 0 and 1.");
  own_->forget_lines();
  for (const auto& piece : own_->pieces.pieces()) piece->scale_move(fraction);
}

int ShapeOptimizer::keep_within(double limit) {
  const Vector move = (heights() - frame().heights(start())).cwiseAbs();
  const double largest = move.maxCoeff();
  if (!(largest > limit)) return 0;
  scale_move(limit / largest);
  return std::max(1, static_cast<int>((move.array() > limit).count()));
}

ShapeOptimizer::Internals::State ShapeOptimizer::Internals::state() const {
  State result{{}, pieces.limit()};
  for (const auto& piece : pieces.pieces()) result.unknowns.push_back(piece->unknowns());
  return result;
}

void ShapeOptimizer::Internals::restore(const State& state) {
  forget_lines();
  pieces.set_limit(state.limit);
  for (size_t k = 0; k < state.unknowns.size(); ++k) pieces.pieces()[k]->set_heights(state.unknowns[k]);
}

void ShapeOptimizer::set_move(const Vector& move) {
  if (own_->kind == SurfaceKind::kSubdivided)
    throw InvalidInput("The vertices of a cage's surface do not move one by one.");
  if (move.size() != own_->pieces.vertex_count() || !move.allFinite()) {
    throw InvalidInput("The move needs one finite number for each of the " +
                       std::to_string(own_->pieces.vertex_count()) + " vertices.");
  }
  own_->pieces.set_limit(MoveLimit::none());
  own_->forget_lines();
  for (const auto& piece : own_->pieces.pieces()) piece->set_move(move(piece->vertices()));
}

void ShapeOptimizer::reset() {
  own_->pieces.set_limit(MoveLimit::none());
  own_->forget_lines();
  for (const auto& piece : own_->pieces.pieces()) piece->reset();
}

void ShapeOptimizer::Internals::rest_at(const Vector& unknowns) {
  pieces.set_limit(MoveLimit::none());  // the shape is a new start, and the last solve's limit was for another one
  forget_lines();
  pieces.pieces().front()->rest_at(unknowns);
}

void ShapeOptimizer::stay_near(const Vector& heights) {
  if (heights.size() != own_->pieces.vertex_count() || !heights.allFinite()) {
    throw InvalidInput("The heights to stay near need one finite number for each of the " +
                       std::to_string(own_->pieces.vertex_count()) + " vertices.");
  }
  own_->pieces.stay_near(heights);
}

void ShapeOptimizer::Internals::tell_limit(Report& report) const {
  if (!pieces.limit().exists()) return;
  const auto free = pieces.free().count();
  report.limited = static_cast<int>((pieces.at_limit().array() != 0).count());
  report.limited_fraction = static_cast<double>(report.limited) / static_cast<double>(free);
  char text[160];
  std::snprintf(text, sizeof text, " %d of %td vertices (%.3g %%) touch the limit.", report.limited, free,
                100 * report.limited_fraction);
  report.message += text;
  if (report.put_back == 0) return;
  std::snprintf(text, sizeof text, " %d were beyond it at the start and were put back to it first.", report.put_back);
  report.message += text;
}

const Region& ShapeOptimizer::region() const { return own_->region; }

int ShapeOptimizer::family_count() const { return own_->family_count; }

const ImagePlane& ShapeOptimizer::frame() const { return own_->pieces.frame(); }

int ShapeOptimizer::count_faces(const Mask& triangles) const { return own_->count_faces(triangles); }

const Positions& ShapeOptimizer::start() const { return own_->pieces.start(); }

const Triangles& ShapeOptimizer::triangles() const { return own_->pieces.triangles(); }

int ShapeOptimizer::triangle_count() const { return own_->pieces.triangle_count(); }

PlanePositions ShapeOptimizer::xy() const { return own_->pieces.xy(); }

PlanePositions ShapeOptimizer::centers() const { return own_->pieces.centers(); }

Vector ShapeOptimizer::area() const { return own_->pieces.area(); }

Vector ShapeOptimizer::heights() const { return own_->pieces.heights(); }

Positions ShapeOptimizer::positions() const { return own_->pieces.positions(); }

IndexVector ShapeOptimizer::at_limit() const { return own_->pieces.at_limit(); }

Mask ShapeOptimizer::free() const { return own_->pieces.free(); }

Mask ShapeOptimizer::active() const { return own_->pieces.active(); }

Mask ShapeOptimizer::changeable() const { return own_->pieces.changeable(); }

Vector ShapeOptimizer::theta(int family) const {
  own_->check_family(family);
  return own_->pieces.theta(family);
}

PlaneVectors ShapeOptimizer::field(int family) const {
  own_->check_family(family);
  return own_->pieces.field(family);
}

Vector ShapeOptimizer::sight(int family) const {
  own_->check_family(family);
  return own_->sight.empty() ? Vector::Ones(triangle_count()) : own_->sight[family];
}

const RegionField& ShapeOptimizer::region_field(int family) {
  own_->check_family(family);
  std::optional<RegionField>& kept = own_->region_fields[family];
  if (!kept) kept = own_->pieces.region_field(family, own_->feature_length);
  return *kept;
}

const RegionField& ShapeOptimizer::vertex_field(int family) {
  own_->check_family(family);
  std::optional<RegionField>& kept = own_->vertex_fields[family];
  if (!kept) kept = own_->pieces.vertex_field(family);
  return *kept;
}

void ShapeOptimizer::Internals::forget_lines() {
  region_fields.clear();
  vertex_fields.clear();
}

ShapeOptimizer::Lines ShapeOptimizer::evaluate_lines(const Vector& heights, const Vector& weight, int family) {
  own_->check_family(family);
  const int vertices = own_->pieces.vertex_count();
  if (heights.size() != vertices || weight.size() != vertices) {
    throw InvalidInput("There are " + std::to_string(heights.size()) + " heights and " + std::to_string(weight.size()) +
                       " weights; the surface has " + std::to_string(vertices) + " vertices.");
  }
  Lines lines{{field(family), Vector::Zero(triangle_count()), {}, family}, theta(family)};
  own_->pieces.read_lines(heights, weight, lines.target, lines.theta);
  return lines;
}

}  // namespace reflines
