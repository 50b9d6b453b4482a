#include "solver/reachable_target.h"

#include <algorithm>
#include <utility>

#include "optimization/report_sums.h"
#include "reflection/reflection_function.h"

namespace reflines {
namespace {

// The relative change (root mean squares) of the unreachable part below which iteration stops: it turns lines by some
// 0.1 degrees.
constexpr double kInvisible = 0.002;
// The number of averages in a row: after one, more of the kinks by random diagonals is left, after more hardly less.
constexpr int kAverages = 2;
// The range of the weight of the previous round in Anderson's method.
constexpr double kFarthest = 4.0, kMostOfBefore = 0.5;

constexpr int kRounds = 3;
// The rounds beside values, which turn quickly at handles and radii: there averages miss a little in each.
constexpr int kRoundsBesideValues = 2;
// The tolerance above which a solve is interactive and is not repeated: rounds would slow a drag down eightfold; its
// last solve, which is kept, is exact.
constexpr double kInteractive = 1e-5;
// The gradient tolerance of a round relative to its own, already small, first gradient.
constexpr double kRoundTolerance = 1e-2;

// Returns whether a limit of the moves holds a vertex: what it forbids is no property of the target.
bool touches_limit(const PieceProblem& piece) {
  bool touches = false;
  for (int v = 0; v < piece.field().vertex_count(); ++v) touches = touches || piece.limited(v) != 0;
  return touches;
}

Mask find_counting_triangles(PieceProblem& piece, const Target& target) {
  const HeightField& field = piece.field();
  Mask counts = piece.visible(target.family).array() > 0;
  for (int t = 0; t < counts.size(); ++t) {
    if (target.weight.size() > 0 && !(target.weight(field.source[t]) > 0)) counts(t) = false;
  }
  return counts;
}

// Takes a solve back. Where the wanted energy is least already, as after a solve for the same target, the rounds end
// beside the start by what they let pass, and above it.
void return_to_start(PieceProblem& piece, const Vector& start, Report& report) {
  piece.set_heights(start);
  report.energy_after = report.energy_before;
  report.gradient_after = report.gradient_before;
  report.termination = Termination::kAlreadyOptimal;
  report.message = "Nothing to do: no heights come nearer to the part of the target that heights can reach.";
}

bool has_values(const Target& target) { return target.reachable_only && target.theta.size() > 0; }

bool is_reduced(const Target& target) { return target.reachable_only && target.theta.size() == 0; }

// The unreachable part of a smooth target is a smooth residual r that in the continuum is orthogonal to every motion:
// the integral of r D phi vanishes for every phi. The second-order stencils D are exact on quadratic heights but not
// conservative: sum A r . D phi is 0 up to noise as large as r on motions of a few triangles, which bends the lines
// from triangle to triangle however fine the mesh is. A target without r has no such effect. r is the fixed point of c
// = average(target - field solved for target - c), found by Anderson's method of depth one: on a 4-8 mesh the imprint
// itself averages to half of r, and plain iteration only halves it in each round.
//
// Beside values r is no longer orthogonal: it balances what the values lack. So what values with reachable_only lack is
// taken off them too; others are to be met.
class ReachableTarget {
 public:
  // Takes `wanted` and `piece`, which must outlive this; targets without reachable_only are not changed.
  ReachableTarget(PieceProblem& piece, const std::vector<Target>& wanted);

  // Subtracts the piece's unreachable rows from `targets` (as many as wanted) after a solve; returns false, and changes
  // nothing, where they have converged.
  bool remove_unreachable(std::vector<Target>& targets);

 private:
  PlaneVectors gather_rows(const Target& target) const;
  PlaneVectors compute_unreached();  // what the lines lack of the targets, rows of one below those of the other
  PlaneVectors average(PlaneVectors values);
  bool is_visible(const PlaneVectors& values) const;
  PlaneVectors extrapolate(const PlaneVectors& left, const PlaneVectors& change) const;

  PieceProblem& piece_;
  const std::vector<Target>& wanted_;
  Vector area_;                                  // area of the rows; 0 where they do not count
  std::vector<Mask> counts_;                     // #T for each target
  double squared_norm_ = 0.0;                    // sum of area |target|^2
  PlaneVectors unreachable_;                     // c
  PlaneVectors last_unreachable_, last_change_;  // of the previous round; empty in the first
};

ReachableTarget::ReachableTarget(PieceProblem& piece, const std::vector<Target>& wanted)
    : piece_(piece), wanted_(wanted) {
  const HeightField& field = piece.field();
  const int n = field.triangle_count();
  area_ = Vector::Zero(n * static_cast<Eigen::Index>(wanted.size()));
  for (size_t k = 0; k < wanted.size(); ++k) {
    const bool rows = is_reduced(wanted[k]) || has_values(wanted[k]);
    const Mask counts = rows ? find_counting_triangles(piece, wanted[k]) : Mask::Constant(n, false);
    if (is_reduced(wanted[k])) {
      area_.segment(static_cast<Eigen::Index>(k) * n, n) = counts.select(field.area.array(), 0.0);
    }
    counts_.push_back(counts);
    squared_norm_ +=
        area_.segment(static_cast<Eigen::Index>(k) * n, n).dot(gather_rows(wanted[k]).rowwise().squaredNorm());
  }
  unreachable_ = PlaneVectors::Zero(area_.size(), 2);
}

PlaneVectors ReachableTarget::gather_rows(const Target& target) const {
  const HeightField& field = piece_.field();
  PlaneVectors rows = PlaneVectors::Zero(field.triangle_count(), 2);
  for (int t = 0; t < rows.rows() && is_reduced(target); ++t) rows.row(t) = target.gradient.row(field.source[t]);
  return rows;
}

PlaneVectors ReachableTarget::compute_unreached() {
  const int n = piece_.field().triangle_count();
  PlaneVectors result = PlaneVectors::Zero(area_.size(), 2);
  for (size_t k = 0; k < wanted_.size(); ++k) {
    auto rows = result.middleRows(static_cast<Eigen::Index>(k) * n, n);
    const Target& target = wanted_[k];
    if (is_reduced(target)) rows = gather_rows(target) - piece_.lines(target.family).gradient;
    if (!has_values(target)) continue;
    const Vector theta = piece_.lines(target.family).theta;
    for (int t = 0; t < n; ++t) {
      if (counts_[k](t)) rows(t, 0) = wrap_angle(target.theta(piece_.field().source[t]) - theta(t));
    }
  }
  return result;
}

PlaneVectors ReachableTarget::average(PlaneVectors values) {
  const int n = piece_.field().triangle_count();
  for (size_t k = 0; k < wanted_.size(); ++k) {
    auto rows = values.middleRows(static_cast<Eigen::Index>(k) * n, n);
    for (int pass = 0; pass < kAverages && counts_[k].any(); ++pass) {
      rows = piece_.average().of(rows, counts_[k]);
    }
  }
  return values;
}

bool ReachableTarget::is_visible(const PlaneVectors& values) const {
  return area_.dot(values.rowwise().squaredNorm()) > kInvisible * kInvisible * squared_norm_;
}

PlaneVectors ReachableTarget::extrapolate(const PlaneVectors& left, const PlaneVectors& change) const {
  if (last_change_.rows() == 0) return left;
  const PlaneVectors difference = change - last_change_;
  const double square = area_.dot(difference.rowwise().squaredNorm());
  if (!(square > 0)) return left;
  const double before = area_.dot(change.cwiseProduct(difference).rowwise().sum()) / square;
  const double weight = std::clamp(before, -kFarthest, kMostOfBefore);
  return (1 - weight) * left + weight * (last_unreachable_ + last_change_);
}

bool ReachableTarget::remove_unreachable(std::vector<Target>& targets) {
  const int n = piece_.field().triangle_count();
  PlaneVectors left = compute_unreached();
  if (!is_visible(left)) return false;  // most solves of reachable targets, without an average
  left = average(std::move(left));
  const PlaneVectors change = left - unreachable_;
  if (!is_visible(change)) return false;
  const PlaneVectors guess = extrapolate(left, change);
  last_unreachable_ = unreachable_;
  last_change_ = change;
  unreachable_ = guess;
  for (size_t k = 0; k < wanted_.size(); ++k) {
    const std::vector<int>& source = piece_.triangles();
    for (int t = 0; t < n; ++t) {
      const auto own = unreachable_.row(static_cast<Eigen::Index>(k) * n + t);
      const int row = source[t];
      if (is_reduced(wanted_[k])) targets[k].gradient.row(row) = wanted_[k].gradient.row(row) - own;
      if (has_values(wanted_[k])) targets[k].theta(row) = wrap_angle(wanted_[k].theta(row) - own.x());
    }
  }
  return true;
}

}  // namespace

Report minimize_reachable(PieceProblem& piece, const std::vector<Target>& wanted, std::vector<Target>& reachable,
                          const MinimizerOptions& options, Progress* progress) {
  const Vector start = piece.unknowns();
  piece.set_targets(wanted);
  Report report = piece.minimize(options, progress);
  // The moves of a cage are smooth from triangle to triangle and imprint nothing.
  const bool reduced = std::any_of(wanted.begin(), wanted.end(), is_reduced);
  if (!reduced || !piece.is_mesh() || touches_limit(piece) || !report.converged() ||
      options.gradient_tolerance > kInteractive) {
    return report;
  }
  if (reachable.empty()) reachable = wanted;
  ReachableTarget target(piece, wanted);
  MinimizerOptions own = options;
  own.gradient_tolerance = std::max(options.gradient_tolerance, kRoundTolerance);
  bool changed = false;
  const int rounds = std::any_of(wanted.begin(), wanted.end(), has_values) ? kRoundsBesideValues : kRounds;
  for (int round = 0; round < rounds && target.remove_unreachable(reachable); ++round) {
    piece.set_targets(reachable);
    add_round_report(piece.minimize(own, progress), report);
    changed = true;
    if (report.termination == Termination::kCancelled) return report;
  }
  if (!changed) return report;
  piece.set_targets(wanted);
  report.energy_after = piece.energy();
  if (!(report.energy_after <= report.energy_before)) return_to_start(piece, start, report);
  return report;
}

}  // namespace reflines
