#include "native/shape_optimizer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native/errors.h"
#include "native/piece_problem.h"

namespace reflines {
namespace {

std::string faces(int n) { return std::to_string(n) + (n == 1 ? " face" : " faces"); }

const Vector3& first_of(const std::vector<Vector3>& line_directions) {
  if (line_directions.empty())
    throw InvalidInput("There is no family of light lines; give at least one line direction.");
  return line_directions.front();
}

Boundary boundary_of(const ShapeOptions& options, Eigen::Index vertex_count) {
  Boundary boundary{options.border, options.held, options.crease_angle, options.motion.empty()};
  if (boundary.border.empty()) boundary.border.assign(vertex_count, Border::kClamped);
  if (static_cast<Eigen::Index>(boundary.border.size()) != vertex_count ||
      (boundary.held.size() > 0 && boundary.held.size() != vertex_count)) {
    throw InvalidInput("The border codes and the held mask need one entry for each of the " +
                       std::to_string(vertex_count) + " vertices.");
  }
  return boundary;
}

void accumulate(const Report& piece, Report& sum) {
  sum.unknowns += piece.unknowns;
  sum.iterations = std::max(sum.iterations, piece.iterations);
  sum.evaluations += piece.evaluations;
  sum.assemblies += piece.assemblies;
  sum.analyses += piece.analyses;
  sum.factorizations += piece.factorizations;
  sum.solves += piece.solves;
  sum.energy_before += piece.energy_before;
  sum.energy_after += piece.energy_after;
  sum.gradient_before = std::hypot(sum.gradient_before, piece.gradient_before);
  sum.gradient_after = std::hypot(sum.gradient_after, piece.gradient_after);
  sum.seconds += piece.seconds;
  // The least happy piece speaks for all; among the happy ones, one that did something.
  const auto rank = [](const Report& r) { return r.converged() ? (r.termination == Termination::kConverged) : 2; };
  if (rank(piece) > rank(sum)) {
    sum.termination = piece.termination;
    sum.message = piece.message;
  }
}

}  // namespace

ShapeOptimizer::ShapeOptimizer(const Positions& V, const Triangles& F, const Vector3& view_direction,
                               const std::vector<Vector3>& line_directions, const ShapeOptions& options)
    : frame_(view_direction, first_of(line_directions)),
      V_(V),
      F_(F),
      triangle_count_(static_cast<int>(F.rows())),
      family_count_(static_cast<int>(line_directions.size())) {
  check_surface(V, F);
  HeightField field = make_height_field(V, F, frame_, boundary_of(options, V.rows()));
  if (!options.motion.empty()) moving_ = couple(options.motion, field);
  std::vector<ReflectionFunction> families;
  for (const Vector3& a : line_directions) families.emplace_back(frame_, frame_.z(), a);
  families.emplace_back(frame_, frame_.z(), frame_.x());  // across the first family: see PieceProblem
  describe(field);
  for (Piece& piece : split_pieces(field)) {
    region_.unused_pieces += piece.free_count == 0;
    Unknowns unknowns = unknowns_of(options.motion, moving_, piece);
    pieces_.push_back(std::make_unique<PieceProblem>(std::move(piece), std::move(unknowns), options.stencil, families,
                                                     options.proximity, options.linear_solver));
    region_.hidden += pieces_.back()->hidden_count();
  }
  if (region_.free == 0) {
    throw InvalidInput(
        "No vertex of the region is free to move (" + faces(triangle_count_) +
        ": all vertices are held by the border, silhouettes or faces turned away); select a larger region, or "
        "choose the border Fixed instead of Clamped.");
  }
  if (region_.unused_pieces > 0) {
    region_.messages.push_back(std::to_string(region_.unused_pieces) + " of " + std::to_string(region_.pieces) +
                               " pieces have no free vertex and stay as they are.");
  }
  if (region_.hidden > 0) {
    region_.messages.push_back("The lines are not defined on " + faces(region_.hidden) +
                               " that mirror the view almost along the light lines; little or no weight there.");
  }
}

ShapeOptimizer::~ShapeOptimizer() = default;

void ShapeOptimizer::describe(const HeightField& field) {
  region_.triangles = field.triangle_count();
  region_.pieces = field.piece_count;
  region_.silhouettes = field.silhouette_count;
  region_.turned_away = field.turned_away_count;
  region_.creases = field.crease_count;
  region_.closed = field.closed;
  region_.free = static_cast<int>(std::count(field.role.begin(), field.role.end(), VertexRole::kFree));
  region_.fixed = static_cast<int>(std::count(field.role.begin(), field.role.end(), VertexRole::kFixed));
  region_.clamped = static_cast<int>(std::count(field.role.begin(), field.role.end(), VertexRole::kClamped));
  if (region_.turned_away > 0) {
    region_.messages.push_back(faces(region_.turned_away) +
                               " turned away from the view or folded over: left as they are.");
  }
  if (region_.creases > 0) {
    region_.messages.push_back(
        std::to_string(region_.creases) + (region_.creases == 1 ? " edge bends" : " edges bend") +
        " too sharply for a fair panel (gaps, folds, hems); held, the lines are solved on each side.");
  }
  if (region_.silhouettes > 0) {
    region_.messages.push_back(faces(region_.silhouettes) + " seen edge on (silhouettes): left as they are.");
  }
}

Vector ShapeOptimizer::heights() const {
  Vector result = frame_.heights(V_);
  for (const auto& piece : pieces_) {
    const std::vector<int>& vertex = piece->piece().vertex;
    for (size_t v = 0; v < vertex.size(); ++v) {
      result(vertex[v]) += piece->heights()(static_cast<int>(v)) - piece->piece().field.z(static_cast<int>(v));
    }
  }
  return result;
}

Positions ShapeOptimizer::positions() const {
  Positions result = V_;
  for (const auto& piece : pieces_) {
    const std::vector<int>& vertex = piece->piece().vertex;
    for (int v = 0; v < static_cast<int>(vertex.size()); ++v) {
      const double move = piece->heights()(v) - piece->piece().field.z(v);
      if (piece->piece().field.role[v] == VertexRole::kFree && move != 0)
        result.row(vertex[v]) += move * frame_.z().transpose();
    }
  }
  return result;
}

Mask ShapeOptimizer::free() const {
  Mask result = Mask::Constant(V_.rows(), false);
  for (const auto& piece : pieces_) {
    for (size_t v = 0; v < piece->piece().vertex.size(); ++v) {
      if (piece->piece().field.role[v] == VertexRole::kFree) result(piece->piece().vertex[v]) = true;
    }
  }
  return result;
}

Mask ShapeOptimizer::active() const {
  Mask result = Mask::Constant(triangle_count_, false);
  for (const auto& piece : pieces_) {
    for (int t : piece->piece().field.source) result(t) = true;
  }
  return result;
}

Vector ShapeOptimizer::theta(int family) const {
  Vector result = Vector::Zero(triangle_count_);
  for (const auto& piece : pieces_) {
    const Vector own = piece->field(family).theta;
    for (int t = 0; t < own.size(); ++t) result(piece->piece().field.source[t]) = own(t);
  }
  return result;
}

PlaneVectors ShapeOptimizer::field(int family) const {
  PlaneVectors result = PlaneVectors::Zero(triangle_count_, 2);
  for (const auto& piece : pieces_) {
    const PlaneVectors own = piece->field(family).gradient;
    for (int t = 0; t < own.rows(); ++t) result.row(piece->piece().field.source[t]) = own.row(t);
  }
  return result;
}

void ShapeOptimizer::check_family(int family) const {
  if (family >= 0 && family < family_count_) return;
  throw InvalidInput("There is no family " + std::to_string(family) + " of light lines; there are " +
                     std::to_string(family_count_) + ", counted from 0.");
}

RegionField ShapeOptimizer::region_field(int family) const {
  check_family(family);
  RegionField result{frame_.project(V_),
                     F_,
                     active(),
                     Vector::Zero(triangle_count_),
                     PlanePositions::Zero(triangle_count_, 2),
                     theta(family),
                     field(family),
                     Vector::Zero(V_.rows()),
                     PlaneVectors::Zero(V_.rows(), 2),
                     family};
  for (int t = 0; t < triangle_count_; ++t) {
    result.center.row(t) = (result.xy.row(F_(t, 0)) + result.xy.row(F_(t, 1)) + result.xy.row(F_(t, 2))) / 3.0;
  }
  for (const auto& piece : pieces_) piece->add_vertex_field(result);
  return result;
}

void ShapeOptimizer::check(const Target& target) const {
  const bool by_value = target.theta.size() > 0;
  const Eigen::Index rows = by_value ? target.theta.size() : target.gradient.rows();
  check_family(target.family);
  if (rows != triangle_count_ || (target.weight.size() > 0 && target.weight.size() != triangle_count_)) {
    throw InvalidInput("The target has " + std::to_string(rows) + " rows and " + std::to_string(target.weight.size()) +
                       " weights; it needs one for each of the " + std::to_string(triangle_count_) + " triangles.");
  }
  const bool finite = by_value ? target.theta.allFinite() : target.gradient.allFinite();
  if (!finite || !target.weight.allFinite() || (target.weight.size() > 0 && target.weight.minCoeff() < 0)) {
    throw InvalidInput("The target has a value that is not finite, or a negative weight.");
  }
}

double ShapeOptimizer::energy(const std::vector<Target>& targets) {
  for (const Target& target : targets) check(target);
  double sum = 0;
  for (const auto& piece : pieces_) {
    piece->set_targets(targets);
    sum += piece->energy();
  }
  return sum;
}

Vector ShapeOptimizer::residual(const Target& target) const {
  check(target);
  if (target.theta.size() > 0) {
    const Vector difference = theta(target.family) - target.theta;
    return difference.unaryExpr([](double d) { return std::abs(std::remainder(d, 2 * std::numbers::pi)); });
  }
  return ((field(target.family) - target.gradient).rowwise().norm().array() * active().cast<double>()).matrix();
}

void ShapeOptimizer::count_features(double length, int family) {
  int count = 0;
  for (const auto& piece : pieces_) count += static_cast<int>(piece->features(length, family).count());
  if (count == region_.features) return;
  region_.features = count;
  region_.messages.push_back(faces(count) +
                             " bend far more than the panel over more than the smoothing length (fillets, hems, "
                             "gaps); their lines are kept.");
}

Target ShapeOptimizer::smooth_target(const SmoothOptions& options, double strength, int family) {
  check_family(family);
  if (!(options.length >= 0) || !std::isfinite(options.length)) {
    throw InvalidInput("The smoothing length must be a positive length in scene units.");
  }
  if (!(strength >= 0 && strength <= 1)) throw InvalidInput("The strength must lie between 0 and 1.");
  Target target;
  target.family = family;
  target.gradient = PlaneVectors::Zero(triangle_count_, 2);
  const bool changes = strength > 0 && options.length > 0;
  if (changes) count_features(options.length, family);
  for (const auto& piece : pieces_) {
    const PlaneVectors own = piece->field(family).gradient;
    const PlaneVectors wanted =
        changes ? PlaneVectors(own + strength * (piece->smoothed(own, options, family) - own)) : own;
    for (int t = 0; t < own.rows(); ++t) target.gradient.row(piece->piece().field.source[t]) = wanted.row(t);
  }
  return target;
}

double ShapeOptimizer::score(double length, int family) {
  double sum = 0, area = 0;
  for (const auto& piece : pieces_) {
    const PlaneVectors own = piece->field(family).gradient;
    const Vector A =
        piece->features(length, family).select(Vector::Zero(own.rows()).array(), piece->changeable_area().array());
    sum += A.dot((own - piece->smoothed(own, {length, false}, family)).rowwise().squaredNorm());
    area += A.sum();
  }
  return area > 0 ? std::sqrt(sum / area) * length * 180.0 / std::numbers::pi : 0.0;
}

void ShapeOptimizer::measure(const std::vector<Target>& targets, Report& report) const {
  double sum = 0, area = 0;
  std::vector<Vector> residuals;
  for (const Target& target : targets) residuals.push_back(residual(target));
  for (const auto& piece : pieces_) {
    const HeightField& field = piece->piece().field;
    report.largest_move = std::max(report.largest_move, (piece->heights() - field.z).cwiseAbs().maxCoeff());
    for (int t = 0; t < field.triangle_count(); ++t) {
      for (const Vector& r : residuals) sum += field.area(t) * r(field.source[t]) * r(field.source[t]);
      area += field.area(t);
    }
  }
  report.residual_rms = std::sqrt(sum / area);
}

Report ShapeOptimizer::solve(const std::vector<Target>& targets, const MinimizerOptions& options, Progress* progress) {
  if (targets.empty()) throw InvalidInput("There is no target to solve for; give at least one.");
  for (const Target& target : targets) check(target);
  std::vector<Vector> before;
  for (const auto& piece : pieces_) before.push_back(piece->unknowns());
  const auto restore = [&] {
    for (size_t k = 0; k < pieces_.size(); ++k) pieces_[k]->set_heights(before[k]);
  };
  Report report;
  report.strategy = options.strategy;
  report.termination = Termination::kAlreadyOptimal;
  try {
    for (const auto& piece : pieces_) {
      if (piece->size() == 0) continue;
      piece->set_targets(targets);
      const Report own = piece->minimize(options, progress);
      if (report.unknowns == 0)
        report = own;
      else
        accumulate(own, report);
      if (own.termination == Termination::kCancelled) break;
    }
  } catch (...) {
    restore();
    throw;
  }
  if (report.termination == Termination::kCancelled) restore();
  measure(targets, report);
  return report;
}

SparseMatrix ShapeOptimizer::hessian(const std::vector<Target>& targets, HessianModel model) {
  for (const Target& target : targets) check(target);
  SparseMatrix result(region_.free, region_.free);
  int first = 0;
  for (const auto& piece : pieces_) {
    if (piece->size() == 0) continue;
    piece->set_targets(targets);
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

void ShapeOptimizer::reset() {
  for (const auto& piece : pieces_) piece->reset();
}

const Vector& ShapeOptimizer::unknowns() const { return pieces_.front()->unknowns(); }
void ShapeOptimizer::rest_at(const Vector& unknowns) { pieces_.front()->rest_at(unknowns); }

}  // namespace reflines
