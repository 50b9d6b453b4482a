#include "reflines/handle_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "following/spline_window.h"
#include "following/window_change.h"
#include "following/window_energy.h"
#include "optimization/minimizer.h"
#include "reflection/reflection_field.h"
#include "reflection/reflection_function.h"
#include "reflines/errors.h"
#include "reflines/kept_target.h"
#include "solver/optimizer_internals.h"
#include "targets/handle_conflicts.h"

namespace reflines {
namespace {

constexpr int kFewestVertices = 4000;  // of the region: below, the solve itself takes no longer
constexpr double kKnots = 10.0;        // in a radius
constexpr double kFewestEdges = 1.5;   // mean edges in a cell
constexpr double kMostCells = 4000;    // of a window: handles of very different radii would need more
constexpr double kMargin = 0.35;       // of the radius: motions come down again beyond it
constexpr int kRounds = 10;
constexpr double kMet = 1e-5;  // radians beside a handle
constexpr double kTolerance = 1e-2;
// The range of the weight of the round before in Anderson's method.
constexpr double kFarthest = 2.0;

bool same(const Handle& one, const Handle& other) {
  const auto equal = [](const auto& a, const auto& b) {
    return a.rows() == b.rows() && a.cols() == b.cols() && (a.array() == b.array()).all();
  };
  const bool pull = one.kind == HandleKind::kPull;
  return one.kind == other.kind && equal(one.triangles, other.triangles) &&
         (pull ? one.radius == other.radius && one.centre.rows() > 0 && equal(one.centre, other.centre)
               : equal(one.points, other.points));
}

double measure_distance(const Vector2& point, const PlanePositions& places) {
  return std::sqrt((places.rowwise() - point.transpose()).rowwise().squaredNorm().minCoeff());
}

}  // namespace

// A place whose line is to be met: its row of motions, its slopes at the start and the change of theta wanted there.
struct FollowedPlace {
  Vector2 xy;  // of the piece
  ModeRow row;
  Vector2 slope;
  double change = 0.0;
};

struct HandleFollower::Window {
  Window(const PieceProblem& piece, const LineHandles& lines, const std::vector<Handle>& handles, Mask part,
         const Mask& moving, double step);

  std::vector<FollowedPlace> choose_places(const std::vector<Handle>& handles, const LineHandles::Places& all) const;
  Vector meet(const std::vector<FollowedPlace>& places);
  void set_terms(const Vector& change);
  void weigh(const std::vector<Handle>& handles, bool keep_others);
  Vector read_firmness() const;
  Vector read_change(const std::vector<FollowedPlace>& places) const;

  const PieceProblem& piece;
  const LineHandles& lines;
  std::vector<Handle> handles;  // that it was made for
  Mask part;                    // of the region
  Vector2 offset;               // of the piece's plane
  SplineWindow window;
  std::vector<ModeRow> still;  // vertices that stay
  Quadrature quadrature;
  Stencils stencils;
  Energy energy;
  TargetTerms terms;
  WindowChange change;
  WindowEnergy problem;
  Minimizer minimizer;
  std::vector<Target> targets;
  Vector c;  // of the last shape
};

namespace {

Mask find_held(const HeightField& field, const Mask& moving) {
  Mask result(field.vertex_count());
  for (int v = 0; v < result.size(); ++v) result(v) = !moving(v) || field.role[v] != VertexRole::kFree;
  return result;
}

Quadrature sample(const SplineWindow& window) {
  Quadrature result{window.sampled_triangles(), Vector(window.samples().size())};
  for (Eigen::Index s = 0; s < result.weight.size(); ++s) result.weight(s) = window.samples()[s].area_ratio;
  return result;
}

}  // namespace

HandleFollower::Window::Window(const PieceProblem& piece, const LineHandles& lines, const std::vector<Handle>& handles,
                               Mask part, const Mask& moving, double step)
    : piece(piece),
      lines(lines),
      handles(handles),
      part(std::move(part)),
      offset((lines.field().xy.row(piece.vertices()[0]) - piece.field().xy.row(0)).transpose()),
      window(piece.field(), piece.stencils(), moving, step),
      still(window.choose_rows(find_held(piece.field(), moving))),
      quadrature(sample(window)),
      stencils(select_stencils(piece.stencils(), quadrature.triangle)),
      energy(piece.field(), stencils, 0.0),
      terms(piece.field(), quadrature, piece.families(), piece.trust(), stencils.triangle_count()),
      change(window, window.choose_rows(!this->part(piece.vertices())), read_firmness(), piece.solver()),
      problem(window, energy, piece.field().z, still, piece.pull_density()),
      minimizer(piece.solver()),
      c(Vector::Zero(window.count())) {
  const RegionField& field = lines.field();
  targets = {{field.gradient, {}, {}, field.family},
             {field.gradient, Vector::Zero(field.F.rows()), field.theta, field.family}};
  TriangleDerivatives u;
  apply_stencils(stencils, piece.field().z, u);
  for (int other = 0; other + 1 < static_cast<int>(piece.families().size()); ++other) {
    if (other == field.family) continue;
    Target kept{PlaneVectors::Zero(field.F.rows(), 2), Vector::Zero(field.F.rows()), {}, other};
    const ReflectionField own = reflection_field(piece.families()[other], u);
    for (size_t s = 0; s < quadrature.triangle.size(); ++s) {
      kept.gradient.row(piece.triangles()[quadrature.triangle[s]]) = own.gradient.row(static_cast<Eigen::Index>(s));
    }
    targets.push_back(std::move(kept));
  }
}

// Reads how firmly the lines of each sample are held within the largest radius.
Vector HandleFollower::Window::read_firmness() const {
  double radius = 0;
  for (const Handle& handle : handles) {
    if (handle.kind == HandleKind::kPull) radius = std::max(radius, handle.radius);
  }
  Vector result(window.samples().size());
  for (Eigen::Index s = 0; s < result.size(); ++s) {
    result(s) = lines.measure_firmness(piece.triangles()[window.samples()[s].triangle]) / std::pow(radius, 4);
  }
  return result;
}

// Sets the weights that follow the handles.
void HandleFollower::Window::weigh(const std::vector<Handle>& now, bool keep_others) {
  for (const int t : quadrature.triangle) {
    const int row = piece.triangles()[t];
    targets[1].weight(row) = lines.weigh_values(now, part, row);
    for (size_t k = 2; k < targets.size(); ++k) targets[k].weight(row) = keep_others ? kKeptWeight : 0.0;
  }
}

// Sets the terms for a change of theta with these coefficients.
void HandleFollower::Window::set_terms(const Vector& coefficients) {
  const RegionField& field = lines.field();
  for (const WindowSample& sample : window.samples()) {
    const int row = piece.triangles()[sample.triangle];
    targets[0].gradient.row(row) = field.gradient.row(row);
    targets[1].theta(row) = field.theta(row);
    if (part(field.F.row(row)).any()) {
      const Vector3 own = sample.D.topRows<3>() * coefficients(sample.mode);
      targets[0].gradient.row(row) += own.tail<2>().transpose();
      targets[1].theta(row) = wrap_angle(field.theta(row) + own(0));
    }
    targets[1].gradient.row(row) = targets[0].gradient.row(row);
  }
  energy.set_terms(terms.build(targets));
}

// Chooses the places to be met, at most two a cell: motions cannot tell apart nearer ones.
std::vector<FollowedPlace> HandleFollower::Window::choose_places(const std::vector<Handle>& now,
                                                                 const LineHandles::Places& all) const {
  const RegionField& field = lines.field();
  std::vector<FollowedPlace> result;
  const auto take = [&](const Location& at, const Vector2& point, double wanted) {
    const Vector2 xy = point - offset;
    if (!window.contains(xy)) return;
    FollowedPlace place{xy, window.row_at(xy), Vector2::Zero(), wanted};
    for (int i = 0; i < 3; ++i) {
      place.slope += at.barycentric(i) * field.vertex_slope.row(field.F(at.triangle, i)).transpose();
    }
    if (!place.row.mode.empty()) result.push_back(std::move(place));
  };
  for (size_t k = 0; k < now.size(); ++k) {
    const size_t first = result.size();
    const auto is_near = [&](const Vector2& point) {
      return std::any_of(result.begin() + static_cast<std::ptrdiff_t>(first), result.end(),
                         [&](const auto& other) { return (other.xy - (point - offset)).norm() < 0.5 * window.step(); });
    };
    for (const HandlePlace& place : all[k]) {
      if (!is_near(place.point)) take(place.at, place.point, place.change);
    }
    for (const int t : now[k].triangles) {
      const Vector2 middle = field.center.row(t);
      if (field.active(t) && !is_near(middle)) take({t, Vector3::Constant(1.0 / 3)}, middle, 0.0);
    }
  }
  return result;
}

Vector HandleFollower::Window::read_change(const std::vector<FollowedPlace>& places) const {
  const ReflectionFunction& lines_of = piece.families()[lines.field().family];
  Vector result(places.size());
  for (Eigen::Index k = 0; k < result.size(); ++k) {
    const Vector2 before = places[k].slope, after = before + window.slope_at(places[k].xy, c);
    result(k) = wrap_angle(lines_of.theta(after.x(), after.y()) - lines_of.theta(before.x(), before.y()));
  }
  return result;
}

// Raises the changes that are asked for until those wanted are reached, by Anderson's method. Returns the motion.
Vector HandleFollower::Window::meet(const std::vector<FollowedPlace>& places) {
  Vector wanted(places.size());
  std::vector<ModeRow> rows;
  for (Eigen::Index k = 0; k < wanted.size(); ++k) {
    wanted(k) = places[k].change;
    rows.push_back(places[k].row);
  }
  if (wanted.isZero(0.0)) return c = Vector::Zero(window.count());
  change.set_places(rows);
  MinimizerOptions options;
  options.gradient_tolerance = kTolerance;
  Vector asked = wanted, last_asked, last_missing;
  for (int round = 0; round < kRounds; ++round) {
    set_terms(change.interpolate(asked));
    minimizer.minimize(problem, c, options);
    const Vector missing = wanted - read_change(places);
    if (missing.lpNorm<Eigen::Infinity>() < kMet) break;
    Vector next = asked + missing;
    if (round > 0) {
      const Vector difference = missing - last_missing;
      const double weight =
          std::clamp(missing.dot(difference) / std::max(difference.squaredNorm(), 1e-300), -kFarthest, kFarthest);
      next = (1 - weight) * next + weight * (last_asked + last_missing);
    }
    last_asked = std::exchange(asked, next);
    last_missing = missing;
  }
  return c;
}

HandleFollower::HandleFollower(const ShapeOptimizer& start, const LineHandles& lines) : start_(start), lines_(lines) {
  const RegionField& field = lines.field();
  const PlanePositions xy = start.xy();
  const bool same_size = field.F.rows() == start.triangle_count() && field.xy.rows() == xy.rows();
  if (same_size && field.xy == xy && field.family < start.family_count()) return;
  throw InvalidInput("The handles' lines are those of another region; make them for the optimizer at the start.");
}

HandleFollower::~HandleFollower() = default;

bool HandleFollower::prepare(const std::vector<Handle>& handles, const LineHandles::Places& places) {
  if (window_ && window_->handles.size() == handles.size() &&
      std::equal(handles.begin(), handles.end(), window_->handles.begin(), same)) {
    return true;
  }
  window_.reset();
  const RegionField& field = lines_.field();
  int piece = -1;
  double smallest = INFINITY;
  for (size_t k = 0; k < handles.size(); ++k) {
    if (handles[k].kind == HandleKind::kPull) smallest = std::min(smallest, handles[k].radius);
    for (const HandlePlace& place : places[k]) {
      if (piece >= 0 && field.piece(place.at.triangle) != piece) return false;
      piece = field.piece(place.at.triangle);
    }
  }
  const PieceProblem& own = start_.internals().pieces.piece_of(piece);
  if (!own.is_mesh() || own.field().vertex_count() < kFewestVertices) return false;
  const Vector2 offset = field.xy.row(own.vertices()[0]) - own.field().xy.row(0);
  Mask moving = Mask::Constant(own.field().vertex_count(), false);
  for (const Handle& handle : handles) {
    if (handle.kind != HandleKind::kPull) continue;
    const PlanePositions& centre = handle.centre.rows() > 0 ? handle.centre : handle.points;
    for (int v = 0; v < moving.size(); ++v) {
      const Vector2 xy = own.field().xy.row(v).transpose() + offset;
      moving(v) = moving(v) || measure_distance(xy, centre) < (1 + kMargin) * handle.radius;
    }
  }
  const double edge = std::sqrt(2 * own.field().area.sum() / own.field().triangle_count());
  const double step = std::max(smallest / kKnots, kFewestEdges * edge);
  const double area = own.field().area.sum() / own.field().vertex_count() * static_cast<double>(moving.count());
  if (area > kMostCells * step * step) return false;
  window_ = std::make_unique<Window>(own, lines_, handles, lines_.find_part(handles, places), moving, step);
  if (window_->window.count() > 0) return true;
  window_.reset();
  return false;
}

bool HandleFollower::follow(const std::vector<Handle>& handles, ShapeOptimizer& optimizer, bool keep_others) {
  const bool pulls = std::any_of(handles.begin(), handles.end(),
                                 [](const Handle& handle) { return handle.kind == HandleKind::kPull; });
  if (!pulls) throw InvalidInput("There is no handle that pulls a line; give at least one.");
  const LineHandles::Places places = lines_.find_places(handles);
  if (!prepare(handles, places)) return false;
  window_->weigh(handles, keep_others);
  Vector z = Vector::Zero(window_->piece.field().vertex_count());
  window_->window.move(window_->meet(window_->choose_places(handles, places)), z);
  Vector move = Vector::Zero(lines_.field().xy.rows());
  move(window_->piece.vertices()) = z;
  optimizer.set_move(move);
  return true;
}

}  // namespace reflines
