#include "restoration/restoration.h"

#include <algorithm>
#include <string>
#include <utility>

#include "geometry/bounding_box.h"
#include "reflines/errors.h"
#include "restoration/line_fields.h"
#include "restoration/press_messages.h"
#include "restoration/smoothed_lines.h"
#include "restoration/turned_faces.h"

namespace reflines {
namespace {

// The jump was chosen by measurement. Of 4, 5, 6 and 7 medians, on four panels: 0.16, 0.17, 0.17, 0.18 degrees of harm,
// 0.43, 0.40, 0.39, 0.38 left of noise, and 0.34 of ripples.
constexpr SmootherOptions kLineSmoother = {.crease_jump = 6.0, .rounds = 6};

// A change that can be seen, degrees of theta, root mean square. Where neither noise nor waves fall (see LineEvenness)
// and a change is larger, only bumps and the halves' differences go: the harm to the worst of 26 panels falls from 1.09
// to 0.3 degrees. Without this bound clean panels do not change at all, but dents on coarse meshes, which are no bumps,
// stay too (0.9 instead of 0.65 left).
constexpr double kVisible = 0.3;

// A light is spared by a share of the move where that is most of it; else the whole move is made.
constexpr double kLeastShare = 0.5;

constexpr int kRetries = 3;

double choose_length(const SmoothPanelOptions& options, const Positions& V) {
  return options.length > 0 ? options.length : options.flaw_size * kAutomaticLength * bounding_box_diagonal(V);
}

SmoothPanelReport start_report(ControlledSurface& surface, const SmoothPanelOptions& options) {
  SmoothPanelReport result;
  result.region = surface.optimizer().region();
  result.length = choose_length(options, surface.positions());
  result.limit = options.limit > 0 ? std::min(options.limit, kNoLimit) : kAutomaticLimit * result.length;
  return result;
}

}  // namespace

Restoration::Restoration(ControlledSurface& surface, const SmoothPanelOptions& options)
    : surface_(surface),
      options_(options),
      axis_(surface.optimizer().frame().z()),
      start_(surface.optimizer().heights()),
      report_(start_report(surface, options)),
      smoother_(surface.optimizer().xy(), surface.triangles(), surface.optimizer().area(), report_.length,
                kLineSmoother),
      evenness_(surface, smoother_, start_, report_.length),
      range_(report_.limit, options.limit_share, surface.control_positions().rows()),
      search_{.halves = options.symmetric},
      held_triangles_(Mask::Constant(surface.triangles().rows(), false)) {}

Vector Restoration::find_move() {
  evenness_.find_creases(progress());
  Vector move = attempt();
  if (!evenness_.has_fallen() && evenness_.measure_change(move) > kVisible && !whole_move_pays(move)) {
    use_smoothing_ = false;
    move = attempt();
  }
  // A shape without the halves' differences, or without what looks like bumps, can be a worse one: of an egg-box of
  // waves that is symmetric but for its phase, every other wave went, and the press was refused.
  const FlawSearch found{.halves = report_.mirrored > 0, .bumps = report_.bumps > 0};
  if (find_worse_light() >= 0 && found.halves) move = attempt_with({.halves = false, .bumps = search_.bumps});
  if (find_worse_light() >= 0 && report_.bumps > 0) {
    move = attempt_with({.halves = found.halves, .bumps = false});
    if (find_worse_light() >= 0 && found.halves) move = attempt_with({.halves = false, .bumps = false});
  }
  return find_worse_light() < 0 ? spare_every_light(move) : move;
}

// Returns whether noise or waves fall by the whole move, of which strength and limit left `move`: a part of it can be
// seen before it has gained enough, and strengths of 0.1 to 0.2 moved nothing where 0.05 and 0.3 did.
bool Restoration::whole_move_pays(const Vector& move) {
  if (report_.limited == 0 && options_.strength == 1) return false;
  measure(unlimited_);
  const bool pays = evenness_.has_fallen();
  measure(move);
  return pays;
}

Vector Restoration::attempt_with(const FlawSearch& search) {
  search_ = search;
  flawless_.reset();
  report_.kept_flaws = true;
  return attempt();
}

// Returns the largest share of the move with which no light is visibly less even than at the start, where that is most
// of it.
Vector Restoration::spare_every_light(const Vector& move) {
  if (!evenness_.is_any_visibly_worse()) return move;
  const std::vector<double> whole = evenness_.after().degrees;
  measure(0.5 * move);
  const double share = evenness_.find_bearable_share(whole);
  if (share > kLeastShare) {
    measure(share * move);
    if (!evenness_.is_any_visibly_worse()) return share * move;
  }
  measure(move);
  return move;
}

bool Restoration::turns_faces(const Vector& move) const { return find_turned_by(move).any(); }

SmoothPanelResult Restoration::judge_move(const Vector& move, const SmoothPanelReport& found, const Mask& limited,
                                          const Mask& held) {
  report_.solve = found.solve;
  report_.bumps = found.bumps;
  report_.mirrored = found.mirrored;
  report_.kept_flaws = found.kept_flaws;
  report_.limited = static_cast<int>(limited.count());
  report_.held_faces = surface_.optimizer().count_faces(held);
  evenness_.find_creases(progress());
  measure(move);
  return judge(move);
}

// Returns the moves of the control vertices (#C) without faces that turn far, and measures their result.
Vector Restoration::attempt() {
  surface_.optimizer().reset();
  Vector move = restore();
  for (int retry = 0; retry < kRetries; ++retry) {
    const Mask turned = find_turned_by(move);
    if (!turned.any()) break;
    held_triangles_ = held_triangles_ || turned;
    report_.held_faces = surface_.optimizer().count_faces(held_triangles_);
    surface_.hold(find_corners(surface_.triangles(), turned, start_.size()));
    flawless_.reset();
    move = restore();
  }
  measure(move);
  // The rim of a flaw far deeper than the limit can make the lines less even than the flaw did. The same share of the
  // whole move everywhere cannot.
  if (report_.limited > 0 && find_worse_light() >= 0) {
    move = options_.strength * range_.share_within(unlimited_) * unlimited_;
    measure(move);
  }
  return move;
}

// Returns the moves of the control vertices (#C).
Vector Restoration::restore() {
  const FlawlessShape& flawless = find_flawless();
  if (!use_smoothing_ && flawless.heights == start_) {
    report_.limited = 0;
    limited_ = Mask::Constant(surface_.control_positions().rows(), false);
    return Vector::Zero(surface_.control_positions().rows());
  }
  const std::vector<Target> targets = make_plan(flawless.heights);
  // Near the start itself, wide dents that had been found were pulled back: 0.2 instead of 0.06 of a bonnet's was left.
  surface_.optimizer().stay_near(flawless.sure_heights);
  solve(targets, MoveLimit::none());
  unlimited_ = read_move();
  limited_ = range_.find_beyond(unlimited_);
  report_.limited = static_cast<int>(limited_.count());
  return options_.strength * (report_.limited == 0 ? unlimited_ : restore_within_limit(targets));
}

// Returns the start without bumps and the halves' differences, which are looked for once.
const FlawlessShape& Restoration::find_flawless() {
  if (!flawless_) {
    flawless_ = find_flawless_shape(surface_, start_, report_.length, search_, options_.partner.size() > 0, progress());
    report_.bumps = flawless_->bumps;
    report_.mirrored = flawless_->mirrored;
  }
  return *flawless_;
}

// Builds the targets: the lines of heights z, smoothed unless they turned out to have no noise.
std::vector<Target> Restoration::make_plan(const Vector& z) {
  const TriangleFields fields = read_fields(surface_.optimizer(), z);
  if (!use_smoothing_) return make_targets(fields);
  const Vector creases = smoother_.find_creases(fields, progress(), evenness_.creases());
  return make_targets(smooth_lines(surface_, smoother_, creases, fields, report_.length));
}

void Restoration::solve(const std::vector<Target>& targets, const MoveLimit& limit) {
  report_.solve = surface_.optimizer().solve(targets, {}, progress(), limit);
  if (report_.solve.termination == Termination::kCancelled) throw Cancelled();
}

// Returns the last solve's moves of the control vertices (#C), those of partners averaged.
Vector Restoration::read_move() const {
  return average_partners(surface_, flawless_->partner, surface_.control_move());
}

// Solves within the limit. A move that is cut there has an edge round every plateau, in lines that were even. Solved
// for, dents three times as deep as the limit leave 0.3 of their error instead of the 0.5 of moves that saturate.
Vector Restoration::restore_within_limit(const std::vector<Target>& targets) {
  if (!surface_.can_limit()) return range_.saturate(unlimited_);
  solve(targets, range_.limits());
  return range_.cut(read_move());
}

Mask Restoration::find_turned_by(const Vector& move) const {
  return find_turned(axis_, surface_.positions(), surface_.triangles(), surface_.surface_move(move));
}

SmoothPanelResult Restoration::judge(const Vector& move) {
  report_.score_before = evenness_.score(Vector::Zero(move.size()));
  report_.score_after = evenness_.score(move);
  report_.unevenness_before = evenness_.before().degrees;
  report_.unevenness_after = evenness_.after().degrees;
  report_.stray = evenness_.after().stray;
  if (turns_faces(move)) return refuse(explain_turned_faces());
  if (const int k = find_worse_light(); k >= 0)
    return refuse(explain_worse_light(report_.unevenness_before[k], report_.unevenness_after[k]));
  report_.largest_move = surface_.surface_move(move).cwiseAbs().maxCoeff();
  report_.largest_control_move = move.cwiseAbs().maxCoeff();
  // With twice the length clean bonnets and roofs, too, would be told to have waves that are longer.
  if (options_.length == 0 && options_.flaw_size <= 1) report_.longer_waves = evenness_.has_longer_waves();
  report_.messages = options_.strength > 0 || report_.limited > 0
                         ? describe_result(report_)
                         : std::vector<std::string>{"The strength is 0: nothing was changed."};
  return {range_.apply(surface_.control_positions(), axis_, move), report_};
}

SmoothPanelResult Restoration::refuse(const std::string& reason) {
  report_.applied = false;
  report_.stray = evenness_.before().stray;
  report_.messages.push_back(reason);
  return {surface_.control_positions(), report_};
}

}  // namespace reflines
