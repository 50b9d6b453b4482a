#include "solver/reachable_target.h"

#include <algorithm>
#include <utility>

namespace reflines {
namespace {

// Of the wish, root mean squares: a change of the unreachable part by this turns lines by some 0.1 degrees.
constexpr double kUnseen = 0.002;
// Averages in a row: of 1, 2 and 4 the third round leaves kinks of 0.7, 0.5, 0.4 degrees with diagonals by chance.
constexpr int kAverages = 2;
// Share of the round before in the next guess, at most this far beyond the last one.
constexpr double kFarthest = 4.0, kMostOfBefore = 0.5;

constexpr int kRounds = 3;
// A solve to fewer digits follows a hand, which rounds would slow down eightfold; the last one, which is kept, is
// exact.
constexpr double kFollowing = 1e-5;
// Of the gradient that a round starts with, itself a small one.
constexpr double kRoundTolerance = 1e-2;

void add_round(const Report& round, Report& sum) {
  sum.iterations += round.iterations;
  sum.coarse_iterations += round.coarse_iterations;
  sum.evaluations += round.evaluations;
  sum.assemblies += round.assemblies;
  sum.analyses += round.analyses;
  sum.factorizations += round.factorizations;
  sum.solves += round.solves;
  sum.seconds += round.seconds;
  if (round.termination == Termination::kCancelled) {
    sum.termination = round.termination;
    sum.message = round.message;
  }
}

// What a limit of the moves forbids is no property of the wish.
bool touches_limit(const PieceProblem& piece) {
  bool touches = false;
  for (int v = 0; v < piece.field().vertex_count(); ++v) touches = touches || piece.limited(v) != 0;
  return touches;
}

Mask counted(PieceProblem& piece, const Target& target) {
  const HeightField& field = piece.field();
  Mask counts = piece.visible(target.family).array() > 0;
  for (int t = 0; t < counts.size(); ++t) {
    if (target.weight.size() > 0 && !(target.weight(field.source[t]) > 0)) counts(t) = false;
  }
  return counts;
}

bool is_asked(const Target& target) { return target.reachable_only && target.theta.size() == 0; }

}  // namespace

ReachableTarget::ReachableTarget(PieceProblem& piece, const std::vector<Target>& wanted)
    : piece_(piece), wanted_(wanted) {
  const HeightField& field = piece.field();
  const int n = field.triangle_count();
  area_ = Vector::Zero(n * static_cast<Eigen::Index>(wanted.size()));
  for (size_t k = 0; k < wanted.size(); ++k) {
    const Mask counts = is_asked(wanted[k]) ? counted(piece, wanted[k]) : Mask::Constant(n, false);
    area_.segment(static_cast<Eigen::Index>(k) * n, n) = counts.select(field.area.array(), 0.0);
    counts_.push_back(counts);
    wish_ += area_.segment(static_cast<Eigen::Index>(k) * n, n).dot(rows_of(wanted[k]).rowwise().squaredNorm());
  }
  unreachable_ = PlaneVectors::Zero(area_.size(), 2);
}

PlaneVectors ReachableTarget::rows_of(const Target& target) const {
  const HeightField& field = piece_.field();
  PlaneVectors rows = PlaneVectors::Zero(field.triangle_count(), 2);
  for (int t = 0; t < rows.rows() && is_asked(target); ++t) rows.row(t) = target.gradient.row(field.source[t]);
  return rows;
}

PlaneVectors ReachableTarget::left_over() {
  const int n = piece_.field().triangle_count();
  PlaneVectors result = PlaneVectors::Zero(area_.size(), 2);
  for (size_t k = 0; k < wanted_.size(); ++k) {
    if (!is_asked(wanted_[k])) continue;
    result.middleRows(static_cast<Eigen::Index>(k) * n, n) =
        rows_of(wanted_[k]) - piece_.lines(wanted_[k].family).gradient;
  }
  return result;
}

PlaneVectors ReachableTarget::averaged(PlaneVectors values) {
  const int n = piece_.field().triangle_count();
  for (size_t k = 0; k < wanted_.size(); ++k) {
    auto rows = values.middleRows(static_cast<Eigen::Index>(k) * n, n);
    for (int time = 0; time < kAverages && is_asked(wanted_[k]); ++time) {
      rows = piece_.average().of(rows, counts_[k]);
    }
  }
  return values;
}

bool ReachableTarget::is_seen(const PlaneVectors& values) const {
  return area_.dot(values.rowwise().squaredNorm()) > kUnseen * kUnseen * wish_;
}

PlaneVectors ReachableTarget::next(const PlaneVectors& left, const PlaneVectors& change) const {
  if (last_change_.rows() == 0) return left;
  const PlaneVectors difference = change - last_change_;
  const double square = area_.dot(difference.rowwise().squaredNorm());
  if (!(square > 0)) return left;
  const double before = area_.dot(change.cwiseProduct(difference).rowwise().sum()) / square;
  const double share = std::clamp(before, -kFarthest, kMostOfBefore);
  return (1 - share) * left + share * (last_unreachable_ + last_change_);
}

bool ReachableTarget::improve(std::vector<Target>& targets) {
  const int n = piece_.field().triangle_count();
  PlaneVectors left = left_over();
  if (!is_seen(left)) return false;  // most solves of wishes that can be met, and no average was needed
  left = averaged(std::move(left));
  const PlaneVectors change = left - unreachable_;
  if (!is_seen(change)) return false;
  const PlaneVectors guess = next(left, change);
  last_unreachable_ = unreachable_;
  last_change_ = change;
  unreachable_ = guess;
  for (size_t k = 0; k < wanted_.size(); ++k) {
    if (!is_asked(wanted_[k])) continue;
    const std::vector<int>& source = piece_.triangles();
    for (int t = 0; t < n; ++t) {
      targets[k].gradient.row(source[t]) =
          wanted_[k].gradient.row(source[t]) - unreachable_.row(static_cast<Eigen::Index>(k) * n + t);
    }
  }
  return true;
}

Report minimize_reachable(PieceProblem& piece, const std::vector<Target>& wanted, std::vector<Target>& reachable,
                          const MinimizerOptions& options, Progress* progress) {
  piece.set_targets(wanted);
  Report report = piece.minimize(options, progress);
  // What a cage moves is smooth from triangle to triangle.
  const bool asked = std::any_of(wanted.begin(), wanted.end(), is_asked);
  if (!asked || !piece.moves_vertices() || touches_limit(piece) || !report.converged() ||
      options.gradient_tolerance > kFollowing) {
    return report;
  }
  ReachableTarget target(piece, wanted);
  MinimizerOptions own = options;
  own.gradient_tolerance = std::max(options.gradient_tolerance, kRoundTolerance);
  bool changed = false;
  for (int round = 0; round < kRounds && target.improve(reachable); ++round) {
    piece.set_targets(reachable);
    add_round(piece.minimize(own, progress), report);
    changed = true;
    if (report.termination == Termination::kCancelled) return report;
  }
  if (!changed) return report;
  piece.set_targets(wanted);
  report.energy_after = piece.energy();
  return report;
}

}  // namespace reflines
