#include "restoration/restoration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/smoothstep.h"
#include "geometry/bounding_box.h"
#include "reflines/errors.h"
#include "restoration/even_places.h"
#include "restoration/healed_flaws.h"
#include "restoration/line_fields.h"
#include "restoration/press_notes.h"
#include "restoration/press_rules.h"
#include "restoration/soft_step.h"
#include "solver/turned_faces.h"

namespace reflines {
namespace {

constexpr double kLongest = 1e3;  // length, relative to the diagonal: all that is longer smooths as much

double choose_length(const SmoothPanelOptions& options, const Positions& V) {
  const double diagonal = bounding_box_diagonal(V);
  const double length = options.length > 0 ? options.length : options.flaw_size * kAutomaticLength * diagonal;
  return std::min(length, kLongest * diagonal);
}

SmoothPanelReport start_report(ControlledSurface& surface, const SmoothPanelOptions& options) {
  SmoothPanelReport result;
  result.region = surface.optimizer().region();
  result.length = choose_length(options, surface.positions());
  return result;
}

// Returns the surface as a height field whose vertices move as the optimizer's do.
HeightField make_field(ControlledSurface& surface) {
  const Mask held = !surface.optimizer().free();
  const Boundary boundary{std::vector<Border>(held.size(), Border::kFree), held, {.rule = CreaseRule::kNone}};
  return make_height_field(surface.positions(), surface.triangles(), surface.optimizer().frame(), boundary);
}

}  // namespace

Restoration::Restoration(ControlledSurface& surface, const SmoothPanelOptions& options)
    : surface_(surface),
      options_(options),
      axis_(surface.optimizer().frame().z()),
      start_(surface.optimizer().heights()),
      report_(start_report(surface, options)),
      range_(0, {}, surface.control_positions().rows()),
      held_triangles_(Mask::Constant(surface.triangles().rows(), false)) {}

PressWork Restoration::take_work() {
  if (smoother_) work_ += smoother_->take_work();
  return std::exchange(work_, {});
}

void Restoration::choose(const PressAmount& amount) {
  amount_ = amount;
  work_ = {};
  surface_.watch(amount.progress);
  SmoothPanelReport report;
  report.region = report_.region;
  report.length = report_.length;
  report.limit = amount.limit > 0 ? std::min(amount.limit, kNoLimit) : kAutomaticLimit * report_.length;
  report_ = std::move(report);
  range_ = ControlRange(report_.limit, amount.limit_range, surface_.control_positions().rows());
}

void Restoration::forget_shape() {
  if (smoother_) work_ += smoother_->take_work();
  smoother_.reset();
}

// Finds the heights without flaws: without differences of a symmetric panel's halves, and then smoothed by place.
void Restoration::find_shape() {
  forget_shape();  // until all is found: a cancelled search is no shape
  unlimited_.resize(0);
  uneven_.reset();
  course_.reset();
  gain_.reset();
  longer_waves_.reset();
  const HeightField field = make_field(surface_);
  reference_ = {.correction = Vector::Zero(start_.size())};
  // Halves are compared without dents: those that lie across from each other in part were each taken for half a flaw of
  // the other half, and what was left was not round: of a bonnet with many 0.17 instead of 0.06.
  const auto correct = [&](const Vector& z) -> Vector {
    if (options_.symmetric) reference_ = even_halves(surface_, field, z, report_.length, options_.partner.size() > 0);
    return reference_.correction;
  };
  auto smoother = std::make_unique<AdaptiveSmoother>(field, report_.length);
  const Vector& heights = smoother->heights();
  shape_ = start_ + (smoother->adapt(heights, progress(), correct) - heights);
  smoother_ = std::move(smoother);
}

Vector Restoration::find_move(const PressAmount& amount) {
  choose(amount);
  if (held_triangles_.any()) {  // what turned by another amount need not turn by this one
    held_triangles_.setConstant(false);
    surface_.rebuild();
    forget_shape();
  }
  Vector move = make_move();
  for (int retry = 0; retry < kRules.verdict.retries; ++retry) {
    const Mask turned = find_turned_by(move);
    if (!turned.any()) break;
    held_triangles_ = held_triangles_ || turned;
    surface_.hold(find_corners(surface_.triangles(), turned, start_.size()));
    forget_shape();
    move = make_move();
  }
  report_.held_faces = surface_.optimizer().count_faces(held_triangles_);
  if (surface_.controls_every_vertex()) return move;
  if (!gain_) gain_ = weigh_gain(unlimited_);
  return *gain_ * move;
}

// Returns the fraction by how much more even the whole move, which no limit holds back, makes the lines. A cage follows
// the shape without flaws only roughly: clean doors were bent by 1.0 to 1.8 degrees for 2 % less unevenness.
double Restoration::weigh_gain(const Vector& move) {
  const Unevenness& before = measure_start();
  const Unevenness after = measure_move(move);
  double gain = 0;
  for (size_t k = 0; k < before.degrees.size(); ++k)
    gain += (1.0 - after.degrees[k] / std::max(before.degrees[k], 1e-300)) / static_cast<double>(before.degrees.size());
  return soft_step(kRules.gain, gain);
}

bool Restoration::turns_faces(const Vector& move) const { return find_turned_by(move).any(); }

SmoothPanelResult Restoration::judge_move(const Vector& move, const SmoothPanelReport& found, const Mask& limited,
                                          const Mask& held) {
  if (!smoother_) find_shape();
  report_.solve = found.solve;
  report_.bumps = found.bumps;
  report_.mirrored = found.mirrored;
  report_.limited = static_cast<int>(limited.count());
  report_.held_faces = surface_.optimizer().count_faces(held);
  return judge(move);
}

// Returns the moves of the control vertices (#C) towards the shape without flaws, within the limit.
Vector Restoration::make_move() {
  if (!smoother_) find_shape();
  if (unlimited_.size() == 0) find_unlimited();
  report_.mirrored = reference_.mirrored;
  report_.bumps = smoother_->bumps();
  report_.solve = unlimited_solve_;
  limited_ = range_.find_beyond(unlimited_);
  report_.limited = static_cast<int>(limited_.count());
  return amount_.strength * (report_.limited == 0 ? unlimited_ : restore_within_limit());
}

// Solves for the shape without flaws. Moves of a mesh begin there, and end there where nothing holds them back.
void Restoration::find_unlimited() {
  ShapeOptimizer& optimizer = surface_.optimizer();
  optimizer.reset();
  targets_ = make_targets(read_fields(optimizer, shape_), options_.set.weight);
  optimizer.stay_near(shape_);
  if (surface_.controls_every_vertex()) optimizer.set_move(shape_ - start_);
  solve(MoveLimit::none());
  unlimited_ = read_move();
  unlimited_solve_ = report_.solve;
  at_unlimited_ = true;
}

void Restoration::solve(const MoveLimit& limit) {
  report_.solve = surface_.optimizer().solve(targets_, {}, progress(), limit);
  if (report_.solve.termination == Termination::kCancelled) throw Cancelled();
  work_ += {report_.solve.factorizations, report_.solve.solves};
  // A mesh's solve begins at the shape without flaws: that it finds nothing to do there is how a press converges.
  const bool moved = (surface_.control_move().array() != 0).any();
  if (moved && report_.solve.termination == Termination::kAlreadyOptimal) {
    report_.solve.termination = Termination::kConverged;
    report_.solve.message = "The shape without flaws was reached.";
  }
}

// Returns the last solve's moves of the control vertices (#C), those of partners averaged.
Vector Restoration::read_move() const { return average_partners(surface_, reference_, surface_.control_move()); }

// Solves within the limit. A move that is cut there has an edge round every plateau, in lines that were even. Solved
// for, dents three times as deep as the limit leave 0.3 of their error instead of the 0.5 of moves that saturate. After
// a solve within another limit the unlimited one is done again, so that no press depends on those before it.
Vector Restoration::restore_within_limit() {
  if (!surface_.can_limit()) return range_.saturate(unlimited_);
  if (!at_unlimited_) find_unlimited();
  at_unlimited_ = false;
  solve(range_.limits());
  return range_.cut(read_move());
}

Mask Restoration::find_turned_by(const Vector& move) const {
  return find_turned(axis_, surface_.positions(), surface_.triangles(), surface_.surface_move(move));
}

// Smooths heights of the surface (#V) up to the lengths found for the start.
Vector Restoration::smooth(const Vector& z) const {
  const Vector relative = smoother_->heights() + (z - start_);
  return z + (smoother_->smooth(relative) - relative);
}

// Compares the lines of heights z (#V) with those of the same, smoothed.
Unevenness Restoration::measure(const Vector& z) const {
  return measure_unevenness(surface_, z, smooth(z), report_.length);
}

Unevenness Restoration::measure_move(const Vector& move) const { return measure(start_ + surface_.surface_move(move)); }

const Unevenness& Restoration::measure_start() {
  if (!uneven_) uneven_ = measure(start_);
  return *uneven_;
}

// Returns whether the shape without flaws has waves longer than these that can be seen.
bool Restoration::has_longer_waves() {
  if (longer_waves_) return *longer_waves_;
  const Vector relative = smoother_->heights() + (shape_ - start_);
  const Vector further = shape_ + (smoother_->smooth_further(relative, progress()) - relative);
  const Unevenness waves = measure_unevenness(surface_, shape_, further, report_.length);
  longer_waves_ = *std::max_element(waves.degrees.begin(), waves.degrees.end()) > kRules.verdict.longer_waves;
  return *longer_waves_;
}

// Reports heights of the surface (#V), and how even their lines are, against the start.
void Restoration::compare_with_start(const Vector& end, Unevenness after) {
  const Unevenness& before = measure_start();
  report_.score_before = before.score;
  report_.score_after = after.score;
  report_.unevenness_before = before.degrees;
  report_.unevenness_after = after.degrees;
  report_.seen = before.seen;
  report_.line_deviation = std::move(after.line_deviation);
  // The course of the lines is that of the shape without flaws, smoothed: what counts as design is in it, and what a
  // limit or the strength leaves of a flaw is not.
  if (!course_) course_ = smooth(shape_);
  HealedPlaces healed = measure_healed(surface_, start_, end, *course_, report_.length, options_.judges);
  report_.healed = healed.flaws;
  report_.verdict = tell_places(healed.fraction);
}

// Returns SmoothPanelReport::verdict for fractions (#F) by which triangles were healed.
Vector Restoration::tell_places(const Vector& healed) const {
  const Vector gone = surface_.gather_faces(healed), kept = surface_.gather_faces(smoother_->design());
  return gone.array() - (1.0 - gone.array()) * kept.array();
}

// Returns a move (#C) that leaves the places as they are where the mean square of what lines deviate rises by `raised`
// of it and more, the more the less even a light becomes in all. A cage has its gain instead, see weigh_gain.
Vector Restoration::leave_uneven_places(const Vector& move, const Unevenness& after, double raised) {
  const Unevenness& before = measure_start();
  double worst = 0;
  for (size_t k = 0; k < before.degrees.size(); ++k)
    worst = std::max(worst, after.degrees[k] / std::max(before.degrees[k], 1e-300));
  const double left = smoothstep(kRules.verdict.even, kRules.verdict.worse, worst);
  if (left == 0 || !surface_.controls_every_vertex()) return move;
  const Vector even =
      find_even_places(surface_, before.squares, after.squares, report_.length, raised, options_.partner);
  return move.array() * (1.0 - left * (1.0 - even.array()));
}

SmoothPanelResult Restoration::judge(const Vector& wanted, bool whole) {
  Vector move = wanted;
  if (amount_.judged) {
    Unevenness after = measure_move(move);
    const int rounds = whole ? 0 : options_.set.exist() ? kRules.verdict.rounds : 1;
    for (int round = 0; round < rounds; ++round) {
      Vector left = leave_uneven_places(move, after, kRules.verdict.raised * std::pow(kRules.verdict.sooner, round));
      if (left == move) break;
      move = std::move(left);
      after = measure_move(move);
    }
    compare_with_start(start_ + surface_.surface_move(move), std::move(after));
  }
  if (turns_faces(move)) return refuse({NoteKind::kFacesWouldTurn});
  for (size_t k = 0; k < report_.unevenness_after.size(); ++k) {
    const double before = report_.unevenness_before[k], after = report_.unevenness_after[k];
    if (after > kRules.verdict.worse * before) return refuse({NoteKind::kLightWouldWorsen, 0, before, after});
  }
  return apply(move);
}

SmoothPanelResult Restoration::apply(const Vector& move) {
  report_.largest_move = surface_.surface_move(move).cwiseAbs().maxCoeff();
  report_.largest_control_move = move.cwiseAbs().maxCoeff();
  if (amount_.judged && options_.length == 0 && options_.flaw_size <= 1) report_.longer_waves = has_longer_waves();
  report_.notes =
      amount_.strength > 0 || report_.limited > 0 ? tell_result(report_) : std::vector<Note>{{NoteKind::kNoStrength}};
  report_.work = take_work();
  return {range_.apply(surface_.control_positions(), axis_, move), report_};
}

SmoothPanelResult Restoration::refuse(const Note& reason) {
  report_.applied = false;
  if (amount_.judged) {
    report_.line_deviation = measure_start().line_deviation;
    report_.verdict = tell_places(Vector::Zero(surface_.triangles().rows()));
  }
  const double worst = report_.healed.worst_before;
  report_.healed = {};
  report_.healed.worst_before = report_.healed.worst_after = worst;
  report_.notes.push_back(reason);
  report_.work = take_work();
  return {surface_.control_positions(), report_};
}

}  // namespace reflines
