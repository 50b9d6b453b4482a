#include "native/shape_optimizer.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native/errors.h"
#include "native/piece_problem.h"

namespace reflines {
namespace {

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
  sum.coarse_iterations = std::max(sum.coarse_iterations, piece.coarse_iterations);
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

// Solves for a drag take 10 to 20 ms: on a machine that is busy with drawing, threads waiting for each other took five
// times as long as one thread alone. The bits are the same.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) : before_(omp_get_max_threads()) {  // 0: no limit
    if (threads > 0) omp_set_num_threads(threads);
  }
  ~ThreadLimit() { omp_set_num_threads(before_); }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int before_;
};

}  // namespace

ShapeOptimizer::ShapeOptimizer(const Positions& V, const Triangles& F, const Vector3& view_direction,
                               const std::vector<Vector3>& line_directions, const ShapeOptions& options)
    : frame_(view_direction, first_of(line_directions)),
      V_(V),
      F_(F),
      triangle_count_(static_cast<int>(F.rows())),
      family_count_(static_cast<int>(line_directions.size())),
      progress_(options.progress) {
  enter(0.0, "checking the mesh");
  check_surface(V, F);
  enter(0.2, "dividing into height fields");
  HeightField field = make_height_field(V, F, frame_, boundary_of(options, V.rows()));
  sampled_ = options.share.size() > 0;
  if (!options.motion.empty()) moving_ = couple(options.motion, field);
  std::vector<ReflectionFunction> families;
  for (const Vector3& a : line_directions) families.emplace_back(frame_, frame_.z(), a);
  families.emplace_back(frame_, frame_.z(), frame_.x());  // across the first family: see PieceProblem
  region_ = describe(field, options.motion.empty());
  feature_length_ = kFeatureLength * field.diagonal();
  for (Piece& piece : split_pieces(field)) {
    enter(0.6, "making stencils");
    region_.unused_pieces += piece.free_count == 0;
    Unknowns unknowns = unknowns_of(options.motion, moving_, piece);
    pieces_.push_back(std::make_unique<PieceProblem>(std::move(piece), std::move(unknowns), options.stencil, families,
                                                     options.proximity, options.linear_solver, options.share));
    pieces_.back()->watch(progress_.get());
    region_.hidden += pieces_.back()->hidden_count();
  }
  if (region_.free == 0) {
    throw InvalidInput(
        "No vertex of the region is free to move (" +
        (options.motion.empty() ? count_of_faces(triangle_count_) + ": " : std::string()) +  // a cage has fewer faces
        "all vertices are held by the border, silhouettes or faces turned away); select a larger region, or a border "
        "that holds less (Fixed or Free).");
  }
  count_features(feature_length_, 0);
  tell_pieces(region_);
}

ShapeOptimizer::~ShapeOptimizer() = default;

void ShapeOptimizer::watch(std::shared_ptr<Progress> progress) {
  progress_ = std::move(progress);
  for (const auto& piece : pieces_) piece->watch(progress_.get());
}

void ShapeOptimizer::enter(double fraction, const char* stage) const {
  if (progress_) progress_->enter(fraction, stage);
}

void ShapeOptimizer::check_family(int family) const {
  if (family >= 0 && family < family_count_) return;
  throw InvalidInput("There is no family " + std::to_string(family) + " of light lines; there are " +
                     std::to_string(family_count_) + ", counted from 0.");
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
    return difference.unaryExpr([](double d) { return std::abs(wrapped(d)); });
  }
  return ((field(target.family) - target.gradient).rowwise().norm().array() * active().cast<double>()).matrix();
}

void ShapeOptimizer::count_features(double length, int family) {
  int count = 0;
  for (const auto& piece : pieces_) count += static_cast<int>(piece->features(length, family).count());
  tell_features(count, region_);
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
    const PlaneVectors wanted = changes && piece->size() > 0
                                    ? PlaneVectors(own + strength * (piece->smoothed(own, options, family) - own))
                                    : own;
    for (int t = 0; t < own.rows(); ++t) target.gradient.row(piece->piece().field.source[t]) = wanted.row(t);
  }
  return target;
}

double ShapeOptimizer::score(double length, int family) {
  double sum = 0, area = 0;
  for (const auto& piece : pieces_) {
    if (piece->size() == 0) continue;
    const PlaneVectors own = piece->field(family).gradient;
    const Vector A = (piece->changeable() && !piece->features(length, family))
                         .select(piece->piece().field.area.cwiseProduct(piece->visible(family)).array(),
                                 Vector::Zero(own.rows()).array());
    sum += A.dot((own - piece->smoothed(own, {length, false}, family)).rowwise().squaredNorm());
    area += A.sum();
  }
  return area > 0 ? std::sqrt(sum / area) * length * 180.0 / std::numbers::pi : 0.0;
}

void ShapeOptimizer::measure(const std::vector<Target>& targets, Report& report) const {
  double squared = 0, area = 0;
  for (const auto& piece : pieces_) {
    const HeightField& field = piece->piece().field;
    report.largest_move = std::max(report.largest_move, (piece->heights() - field.z).cwiseAbs().maxCoeff());
    const PieceProblem::Misfit own = piece->misfit(targets);
    squared += own.squared;
    area += own.area;
  }
  report.residual_rms = area > 0 ? std::sqrt(squared / area) : 0.0;
}

Report ShapeOptimizer::solve(const std::vector<Target>& targets, const MinimizerOptions& options, Progress* progress) {
  const ThreadLimit few(sampled_ ? 1 : 0);
  if (targets.empty()) throw InvalidInput("There is no target to solve for; give at least one.");
  for (const Target& target : targets) check(target);
  region_field_.reset();
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
  region_field_.reset();
  for (const auto& piece : pieces_) piece->reset();
}

const Vector& ShapeOptimizer::unknowns() const { return pieces_.front()->unknowns(); }

void ShapeOptimizer::rest_at(const Vector& unknowns) {
  region_field_.reset();
  pieces_.front()->rest_at(unknowns);
}

void ShapeOptimizer::pull_to(const Vector& heights, const Vector& weight) {
  PieceProblem& piece = *pieces_.front();
  const std::vector<int>& vertex = piece.piece().vertex;
  const Vector now = this->heights();
  Vector z = piece.heights(), w = Vector::Zero(z.size());
  for (int v = 0; v < z.size(); ++v) {
    if (weight(vertex[v]) == 0) continue;
    z(v) += heights(vertex[v]) - now(vertex[v]);
    w(v) = weight(vertex[v]);
  }
  piece.pull_to(z, w);
}

}  // namespace reflines
