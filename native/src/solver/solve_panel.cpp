#include "reflines/solve_panel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reflines/errors.h"
#include "solver/optimizer_internals.h"
#include "solver/rim_bend.h"
#include "solver/turned_faces.h"

namespace reflines {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Fraction of the triangles up to which those that turn are held. Where more of them turn, it is the wanted lines that
// turn them, and holding helps nobody.
constexpr double kMostHeld = 0.02;

constexpr int kMostHolds = 3;  // times that faces are held and the rest is solved again

// The reached fraction of a target below which it falls short, and the wanted change, relative to the lines' gradient,
// below which it does not: lines that are already as wanted differ by as much.
constexpr double kSmallFraction = 0.2, kSmallChange = 0.01;

// Returns the root mean square of values (#F), weighted as the residual is.
double mean_of(const ShapeOptimizer& optimizer, const Target& target, const Vector& values) {
  Vector weight = optimizer.changeable().select(optimizer.area().array(), 0.0);
  if (target.weight.size() > 0) weight = weight.cwiseProduct(target.weight);
  return std::sqrt(weight.dot(values.cwiseAbs2()) / std::max(weight.sum(), 1e-300));
}

// Solves within a limit, and with vertices held.
class LimitedSolve {
 public:
  LimitedSolve(ShapeOptimizer& optimizer, const std::vector<Target>& targets, const SolvePanelOptions& options,
               Progress* progress)
      : optimizer_(optimizer), targets_(targets), options_(options), progress_(progress) {}

  // Returns the report, with the count of vertices that the limit holds back. `held` (#V): vertices that stay.
  Report run(const Mask& held) {
    if (options_.limit_range.exists()) return count_limited(solve(spread_limit(held)), held);
    const Report free = solve(held.any() ? bound(kInfinity, held) : MoveLimit::none());
    if (free.largest_move <= options_.limit || free.termination == Termination::kCancelled) return unlimited(free);
    const int beyond = optimizer_.keep_within(options_.limit);
    if (free.unknowns <= most_bounded()) return count_limited(solve(bound(options_.limit, held)), held);
    Report scaled = free;
    scaled.largest_move = options_.limit;
    scaled.limited = beyond;
    return scaled;
  }

 private:
  Report solve(const MoveLimit& limit) { return optimizer_.solve(targets_, {}, progress_, limit); }

  int most_bounded() const {
    if (options_.most_bounded > 0) return options_.most_bounded;
    return optimizer_.internals().free_unknowns.empty() ? kMostBounded : kMostBoundedCage;
  }

  MoveLimit bound(double length, const Mask& held) const {
    const Vector highest = held.select(Vector::Zero(held.size()).array(), length);
    return {-highest, highest};
  }

  MoveLimit spread_limit(const Mask& held) const {
    const auto scale = [&](const Vector& fraction) -> Vector {  // without the product of zero and infinity
      return (held || fraction.array() == 0)
          .select(Vector::Zero(fraction.size()).array(), options_.limit * fraction.array());
    };
    return {scale(options_.limit_range.lowest), scale(options_.limit_range.highest)};
  }

  static Report unlimited(Report report) {
    report.limited = 0;
    return report;
  }

  // Counts the vertices at their limit without those that are held by a limit of 0.
  Report count_limited(Report report, const Mask& held) const {
    report.limited = static_cast<int>((optimizer_.at_limit().array() != 0 && !held).count());
    return report;
  }

  ShapeOptimizer& optimizer_;
  const std::vector<Target>& targets_;
  const SolvePanelOptions& options_;
  Progress* progress_;
};

Mask find_turned_faces(const ShapeOptimizer& optimizer, const Vector& start) {
  return find_turned(optimizer.frame().z(), optimizer.start(), optimizer.triangles(), optimizer.heights() - start);
}

bool is_worth_holding(const Mask& turned) {
  const auto count = turned.count();
  return count > 0 && static_cast<double>(count) <= std::max(1.0, kMostHeld * static_cast<double>(turned.size()));
}

// Solves again with the vertices held of faces that turn, from the optimizer's start; empty where that fails.
std::optional<Report> solve_held(ShapeOptimizer& optimizer, LimitedSolve& limited, const Mask& held) {
  try {
    optimizer.scale_move(0.0);
    const Report report = limited.run(held);
    if (report.termination != Termination::kCancelled) return report;
  } catch (const InvalidInput&) {
  } catch (const SolverFailure&) {
  }
  return std::nullopt;
}

// Scores the lines of the heights that the optimizer was built with: the targets of some tools have moved it.
LineScore score_start(ShapeOptimizer& optimizer, const Vector& start, double length) {
  if (optimizer.heights() == start) return optimizer.score(length, 0);
  const ShapeOptimizer::Internals::State moved = optimizer.internals().state();
  optimizer.scale_move(0.0);
  const LineScore result = optimizer.score(length, 0);
  optimizer.internals().restore(moved);
  return result;
}

void check(const std::vector<Target>& targets, const SolvePanelOptions& options) {
  if (targets.empty()) throw InvalidInput("There is no target to solve for; give at least one.");
  if (!(options.limit >= 0)) throw InvalidInput("The limit of a panel's moves must be 0 or more, in scene units.");
}

// Measures what the solve has left of the first target.
void measure_result(ShapeOptimizer& optimizer, const Target& wanted, const SolvePanelOptions& options,
                    SolvePanelReport& result) {
  result.residual = optimizer.residual(wanted);
  result.residual_after = mean_of(optimizer, wanted, result.residual);
  result.score_after = optimizer.score(options.length, 0);
  const double steepness = mean_of(optimizer, wanted, optimizer.field(wanted.family).rowwise().norm());
  result.falls_short = result.residual_after > (1.0 - kSmallFraction) * result.residual_before &&
                       result.residual_before > kSmallChange * steepness;
  result.rim_bend = measure_rim_bend(optimizer.start(), optimizer.positions(), optimizer.triangles(), options.around);
}

}  // namespace

double measure_residual(const ShapeOptimizer& optimizer, const Target& target) {
  return mean_of(optimizer, target, optimizer.residual(target));
}

SolvePanelReport solve_panel(ShapeOptimizer& optimizer, const std::vector<Target>& targets,
                             const SolvePanelOptions& options, Progress* progress) {
  check(targets, options);
  const Vector start = optimizer.frame().heights(optimizer.start());
  SolvePanelReport result;
  result.score_before = score_start(optimizer, start, options.length);
  result.residual_before = measure_residual(optimizer, targets.front());
  LimitedSolve limited(optimizer, targets, options, progress);
  Mask held = Mask::Constant(start.size(), false);
  result.solve = limited.run(held);
  Mask turned = find_turned_faces(optimizer, start);
  for (int hold = 0; hold < kMostHolds && is_worth_holding(turned); ++hold) {
    if (std::isinf(options.limit) || result.solve.termination == Termination::kCancelled) break;
    const ShapeOptimizer::Internals::State before = optimizer.internals().state();
    held = held || find_corners(optimizer.triangles(), turned, start.size());
    const std::optional<Report> firmer = solve_held(optimizer, limited, held);
    const Mask left = firmer ? find_turned_faces(optimizer, start) : turned;
    if (left.count() >= turned.count()) {
      optimizer.internals().restore(before);
      break;
    }
    result.solve = *firmer;
    result.held_faces += optimizer.count_faces(turned && !left);
    turned = left;
  }
  result.limited = result.solve.limited;
  result.turned_faces = optimizer.count_faces(turned);
  measure_result(optimizer, targets.front(), options, result);
  return result;
}

}  // namespace reflines
