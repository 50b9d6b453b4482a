#include "restoration/restoration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "geometry/height_field.h"
#include "geometry/mesh.h"
#include "reflection/reflection_function.h"
#include "reflection/weighted_median.h"
#include "reflines/errors.h"
#include "restoration/bump_removal.h"
#include "restoration/flaw_weight.h"
#include "restoration/length_choice.h"
#include "restoration/longer_waves.h"
#include "restoration/mirror_evidence.h"

namespace reflines {
namespace {

// Length of flaws relative to the diagonal. Of 1/8, 1/10, 1/12, 1/14 and 1/16 the shorter ones harm clean panels less
// (0.26 to 0.17 degrees in the median) and ripples and noise go as well; dents are wider, and are looked for by
// themselves.
constexpr double kAutomaticLength = 1.0 / 14.0;

// Limit relative to the length: dents of 6 per mille of the length are taken out whole, and no design is moved by more
// than an artist may overlook.
constexpr double kAutomaticLimit = 1.0 / 20.0;

// The jump was chosen by measurement. Of 4, 5, 6 and 7 medians, on four panels: 0.16, 0.17, 0.17, 0.18 degrees of harm,
// 0.43, 0.40, 0.39, 0.38 left of noise, and 0.34 of ripples.
constexpr SmootherOptions kLineSmoother = {.crease_jump = 6.0, .rounds = 6};

// Share of the limit: moves from here on are less than asked for, so that they reach it without an edge; those of 2 -
// kSaturating and more are the limit itself.
constexpr double kSaturating = 0.6;

// Height, relative to the diagonal: where vertices that stay differ by more from their partners, the move is not made
// symmetric, which would kink the lines beside them.
constexpr double kSymmetricHold = 1e-5;

// Shares by which the median stray of the lines, or its root mean square, has to fall, in the mean of the lights, for
// changes that can be seen (degrees of theta, root mean square). The press smooths for noise and ripples, which are
// everywhere: with planted ones the median falls by 30 to 84 % in 47 of 52 trials on 26 panels, on clean panels by -9
// to 29 %, on three faceted ones by 57 to 65 %. Features own the root mean square, which falls by 0 to 5 % on these
// panels whatever is healed; where there are none, it tells of waves that are longer than noise. Where neither falls,
// only bumps and the halves' differences go: the harm to the worst of 26 panels falls from 1.09 to 0.3 degrees. Without
// the bound of what can be seen clean panels do not change at all, but dents on coarse meshes, which are no bumps, stay
// too (0.9 instead of 0.65 left).
constexpr double kLeastGain = 0.3, kLeastSquareGain = 0.1, kVisible = 0.3;

// Lengths, relative to that of the flaws, up to which the lines are smoothed; see share_lengths. The first two, three,
// four and five of these leave 0.41, 0.39, 0.39, 0.39 of noise on four panels and 0.23, 0.20, 0.18, 0.18 of the flaws
// of a bonnet with ripples and wide dents; three and four cost 5 and 10 % of a press. Not taken: 16, by which clean
// designs of flutes and waves, which eight times the length takes away as well, are harmed by 1.6 instead of 0.2
// degrees (0.39 instead of 0.67 of a door's long waves would be left). The creases of all are those of the first: with
// creases found anew twice as much was left of ripples round a scoop, whose own bends went. Below a cage the first is
// taken everywhere: with all of them a clean door moved by 0.8 mm instead of 0.4.
constexpr double kStretches[] = {1.0, 2.0, 4.0, 8.0};

// An infinite limit becomes this, since a vertex with a share of 0 stays: infinity times 0 is no number.
constexpr double kNoLimit = std::numeric_limits<double>::max();

constexpr double kTurned = std::numbers::pi / 4;
constexpr int kRetries = 3;
constexpr double kWorse = 1.01;

// A light may be less even by no more than this without a try to spare it, by most of the move: somewhat less than the
// share that the parabola gives, since the creases of start and result differ a little with it.
constexpr double kVisiblyWorse = 1.0001, kSpared = 0.95, kLeastShare = 0.5;

double diagonal_of(const Positions& V) { return (V.colwise().maxCoeff() - V.colwise().minCoeff()).norm(); }

double choose_length(const SmoothPanelOptions& options, const Positions& V) {
  return options.length > 0 ? options.length : options.flaw_size * kAutomaticLength * diagonal_of(V);
}

// Projects the axes of the object's space to the image plane: mirror planes are looked for across them.
PlanePositions project_axes(const ImagePlane& frame) {
  PlanePositions axes(3, 2);
  for (int k = 0; k < 3; ++k) axes.row(k) = frame.to_frame(Vector3::Unit(k)).head<2>();
  return axes;
}

std::vector<Target> make_targets(const TriangleFields& fields) {
  std::vector<Target> result(fields.cols() / 2);
  for (size_t k = 0; k < result.size(); ++k) {
    result[k].gradient = fields.middleCols(2 * static_cast<Eigen::Index>(k), 2);
    result[k].family = static_cast<int>(k);
  }
  return result;
}

// Keeps a move, in units of the limit, within it by a function that is C^2, since an edge in the moves would be seen in
// the lines.
double saturate(double move) {
  const double size = std::abs(move), t = std::clamp((size - kSaturating) / (2 * (1 - kSaturating)), 0.0, 1.0);
  if (t == 0) return move;
  return std::copysign(kSaturating + 2 * (1 - kSaturating) * t * (1 - t * t * (1 - 0.5 * t)), move);
}

// Returns by what share numbers, one for each light, fell in the mean.
double measure_gain(const std::vector<double>& before, const std::vector<double>& after) {
  double sum = 0;
  for (size_t k = 0; k < after.size(); ++k) sum += 1 - after[k] / std::max(before[k], 1e-300);
  return sum / static_cast<double>(after.size());
}

// Returns the share of a move with which a light's unevenness rises by kVisiblyWorse. Its square is nearly a parabola
// over the share, given by the unevenness at the start, with half of the move and with the whole.
double bearable_share(double start, double half, double whole) {
  const double curve = 2.0 * (whole * whole + start * start - 2.0 * half * half);
  const double slope = whole * whole - start * start - curve;
  const double rise = (kVisiblyWorse * kVisiblyWorse - 1.0) * start * start;
  return 2.0 * rise / (slope + std::sqrt(std::max(slope * slope + 4.0 * curve * rise, 0.0)));
}

// Returns the median over area (#F) of how long the rows of each light's two columns are, one number for each light.
std::vector<double> find_medians(const TriangleFields& fields, const Vector& area) {
  std::vector<double> result;
  for (Eigen::Index k = 0; k < fields.cols(); k += 2)
    result.push_back(weighted_median(fields.middleCols(k, 2).rowwise().norm(), area));
  return result;
}

std::string degrees(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string count_of(int count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

Restoration::Restoration(ControlledSurface& surface, const SmoothPanelOptions& options)
    : surface_(surface),
      options_(options),
      frame_(surface.optimizer().frame()),
      start_(surface.optimizer().heights()),
      smoother_(surface.optimizer().xy(), surface.triangles(), surface.optimizer().area(),
                choose_length(options, surface.positions()), kLineSmoother) {
  report_.region = surface.optimizer().region();
  report_.length = choose_length(options, surface.positions());
  report_.limit = options.limit > 0 ? std::min(options.limit, kNoLimit) : kAutomaticLimit * report_.length;
  const MoveLimit& share = options.limit_share;
  range_ = MoveLimit::within(report_.limit, static_cast<int>(surface.control_positions().rows()));
  if (share.exists()) range_ = {report_.limit * share.lowest, report_.limit * share.highest};
}

// Returns how far a control vertex may go in the direction of a move.
double Restoration::range_towards(Eigen::Index control, double move) const {
  return move < 0 ? -range_.lowest(control) : range_.highest(control);
}

Vector Restoration::find_move() {
  creases_ = smoother_.find_creases(read_fields(start_), progress(), creases_);
  Vector move = attempt();
  if (measure_gain(typical_before_, typical_after_) < kLeastGain &&
      measure_gain(report_.unevenness_before, report_.unevenness_after) < kLeastSquareGain &&
      measure_change(move) > kVisible) {
    use_smoothing_ = false;
    move = attempt();
  }
  // A shape without the halves' differences, or without what looks like bumps, can be a worse one: of an egg-box of
  // waves that is symmetric but for its phase, every other wave went, and the press was refused.
  if (find_worse_light() >= 0 && report_.mirrored > 0) {
    use_symmetry_ = false;
    flawless_.reset();
    move = attempt();
  }
  if (find_worse_light() >= 0 && report_.bumps > 0) {
    use_bumps_ = false;
    flawless_.reset();
    move = attempt();
  }
  return find_worse_light() < 0 ? spare_every_light(move) : move;
}

// Returns the largest share of the move with which no light is visibly less even than at the start, where that is most
// of it.
Vector Restoration::spare_every_light(const Vector& move) {
  const std::vector<double> whole = report_.unevenness_after;
  if (!is_any_worse()) return move;
  measure_result(0.5 * move);
  double share = 1.0;
  for (size_t k = 0; k < whole.size(); ++k) {
    if (whole[k] > kVisiblyWorse * report_.unevenness_before[k])
      share = std::min(share,
                       kSpared * bearable_share(report_.unevenness_before[k], report_.unevenness_after[k], whole[k]));
  }
  if (share > kLeastShare) {
    measure_result(share * move);
    if (!is_any_worse()) return share * move;
  }
  measure_result(move);
  return move;
}

bool Restoration::is_any_worse() const {
  for (size_t k = 0; k < report_.unevenness_after.size(); ++k) {
    if (report_.unevenness_after[k] > kVisiblyWorse * report_.unevenness_before[k]) return true;
  }
  return false;
}

bool Restoration::turns_faces(const Vector& move) const { return find_turned(surface_.surface_move(move)).any(); }

SmoothPanelResult Restoration::judge_move(const Vector& move, const SmoothPanelReport& found, const Mask& limited) {
  report_.solve = found.solve;
  report_.bumps = found.bumps;
  report_.mirrored = found.mirrored;
  report_.held_faces = found.held_faces;
  report_.limited = static_cast<int>(limited.count());
  creases_ = smoother_.find_creases(read_fields(start_), progress(), creases_);
  measure_result(move);
  return judge(move);
}

// Returns the moves of the control vertices (#C) without faces that turn far, and measures their result.
Vector Restoration::attempt() {
  surface_.optimizer().reset();
  Vector move = restore();
  for (int retry = 0; retry < kRetries; ++retry) {
    const Mask turned = find_turned(surface_.surface_move(move));
    if (!turned.any()) break;
    report_.held_faces += surface_.optimizer().count_faces(turned);
    surface_.hold(find_corners(turned));
    flawless_.reset();
    move = restore();
  }
  measure_result(move);
  if (report_.limited > 0 && find_worse_light() >= 0) {
    move = scale_to_limit();
    measure_result(move);
  }
  return move;
}

// Returns the moves of the control vertices (#C).
Vector Restoration::restore() {
  const Vector& flawless = find_flawless();
  if (!use_smoothing_ && flawless == start_) {
    report_.limited = 0;
    limited_ = Mask::Constant(range_.lowest.size(), false);
    return Vector::Zero(surface_.control_positions().rows());
  }
  const std::vector<Target> targets = plan(flawless);
  // Near the start itself, wide dents that had been found were pulled back: 0.2 instead of 0.06 of a bonnet's was left.
  surface_.optimizer().stay_near(rest_);
  solve(targets, MoveLimit::none());
  unlimited_ = average_partners(surface_.control_move());
  limited_ = unlimited_.array() > range_.highest.array() || unlimited_.array() < range_.lowest.array();
  report_.limited = static_cast<int>(limited_.count());
  return options_.strength * (report_.limited == 0 ? unlimited_ : restore_within_limit(targets));
}

// Returns the heights of the start without bumps and the halves' differences, which are looked for once.
const Vector& Restoration::find_flawless() {
  if (flawless_) return *flawless_;
  report_.mirrored = 0;
  partner_.resize(0);
  flawless_ = remove_bumps(options_.symmetric && use_symmetry_ ? use_symmetry(start_) : start_);
  return *flawless_;
}

void Restoration::solve(const std::vector<Target>& targets, const MoveLimit& limit) {
  report_.solve = surface_.optimizer().solve(targets, {}, progress(), limit);
  if (report_.solve.termination == Termination::kCancelled) throw Cancelled();
}

// Solves within the limit. A move that is cut there has an edge round every plateau, in lines that were even. Solved
// for, dents three times as deep as the limit leave 0.3 of their error instead of the 0.5 of moves that saturate.
Vector Restoration::restore_within_limit(const std::vector<Target>& targets) {
  if (surface_.can_limit()) {
    solve(targets, range_);
    return average_partners(surface_.control_move()).cwiseMax(range_.lowest).cwiseMin(range_.highest);
  }
  Vector move = unlimited_;
  for (Eigen::Index c = 0; c < move.size(); ++c) {
    const double range = range_towards(c, move(c));
    move(c) = range > 0 ? range * saturate(move(c) / range) : 0;
  }
  return move;
}

Vector Restoration::use_symmetry(const Vector& z) {
  const PlanePositions axes = project_axes(frame_);
  const ShapeOptimizer& optimizer = surface_.optimizer();
  const MirrorEvidence evidence = find_mirror_evidence(optimizer.xy(), z, surface_.triangles(),
                                                       diagonal_of(surface_.positions()), report_.length, axes);
  report_.mirrored = static_cast<int>(evidence.partner.size());
  if (report_.mirrored == 0) return z;
  const Positions& C = surface_.control_positions();
  partner_ = find_mirror_partners(frame_.project(C), frame_.heights(C), diagonal_of(C), axes);
  const Mask design = surface_.controls_of(evidence.design);
  for (Eigen::Index c = 0; c < partner_.size(); ++c) {
    if (design(c)) partner_(c) = static_cast<int>(c);
  }
  // Given mirror images move alike whatever was found.
  if (options_.partner.size() > 0 || !is_held_symmetrically()) partner_.resize(0);
  return z + evidence.correction;
}

// Returns heights z (#V) without bumps.
Vector Restoration::remove_bumps(const Vector& z) {
  report_.bumps = 0;
  rest_ = z;
  if (!use_bumps_) return z;
  const Boundary boundary{
      std::vector<Border>(z.size(), Border::kFree), !surface_.optimizer().free(), {.rule = CreaseRule::kNone}};
  const HeightField field = make_height_field(surface_.positions(), surface_.triangles(), frame_, boundary);
  Vector move = z - start_;
  Vector sure = move;
  report_.bumps = BumpRemoval(field, report_.length).remove_all(move, sure, progress());
  rest_ = start_ + sure;
  return start_ + move;
}

// Builds the targets: the lines of heights z, smoothed where that is no change of the design, and as far as flaws
// reach.
std::vector<Target> Restoration::plan(const Vector& z) {
  const ShapeOptimizer& optimizer = surface_.optimizer();
  const TriangleFields fields = read_fields(z);
  if (!use_smoothing_) return make_targets(fields);
  const Vector creases = smoother_.find_creases(fields, progress(), creases_);
  const std::vector<TriangleFields> changes = smooth_further(creases, fields);
  const Eigen::MatrixXd weight = weigh_changes(changes);
  const Eigen::MatrixXd share = share_lengths(changes, weight, optimizer.centers(), optimizer.area(), report_.length);
  TriangleFields target = fields;
  for (Eigen::Index k = 0; k < share.cols(); ++k)
    target += weight.col(k).cwiseProduct(share.col(k)).asDiagonal() * changes[k];
  return make_targets(target);
}

// Returns the changes (#F x m each) that smoothing makes to fields up to the length of flaws times kStretches; below a
// cage the first alone.
std::vector<TriangleFields> Restoration::smooth_further(const Vector& creases, const TriangleFields& fields) const {
  std::vector<TriangleFields> result;
  for (const double stretch : kStretches) {
    result.push_back(smoother_.smooth_with(creases, fields, stretch) - fields);
    if (!surface_.controls_every_vertex()) break;
  }
  return result;
}

// Returns the weights as flaws (#F x #lengths that can be chosen) of these changes.
Eigen::MatrixXd Restoration::weigh_changes(const std::vector<TriangleFields>& changes) const {
  const ShapeOptimizer& optimizer = surface_.optimizer();
  Eigen::MatrixXd result(optimizer.triangle_count(), std::max<Eigen::Index>(1, std::ssize(changes) - 1));
  for (Eigen::Index k = 0; k < result.cols(); ++k)
    result.col(k) = flaw_weight(changes[k], optimizer.centers(), optimizer.area(), report_.length);
  return result;
}

// Returns true where the control vertices that stay are as high as their partners.
bool Restoration::is_held_symmetrically() const {
  const Positions& C = surface_.control_positions();
  const Vector z = frame_.heights(C);
  const Mask free = surface_.control_free();
  for (Eigen::Index v = 0; v < partner_.size(); ++v) {
    const bool moves = free(v) && free(partner_(v));
    if (!moves && std::abs(z(v) - z(partner_(v))) > kSymmetricHold * diagonal_of(C)) return false;
  }
  return partner_.size() > 0;
}

// Averages the heights of partners. Stencils and the cut of quads are not symmetric, so that the solve leaves partners
// 3e-5 of the diagonal apart.
Vector Restoration::average_partners(const Vector& move) const {
  if (partner_.size() == 0) return move;
  const Vector z = frame_.heights(surface_.control_positions()) + move;
  const Mask free = surface_.control_free();
  Vector result = move;
  for (Eigen::Index v = 0; v < z.size(); ++v) {
    if (free(v) && free(partner_(v))) result(v) += 0.5 * (z(partner_(v)) - z(v));
  }
  return result;
}

// Scales the whole move. The rim of a flaw far deeper than the limit can make the lines less even than the flaw did.
// The same share of the whole move everywhere cannot.
Vector Restoration::scale_to_limit() const {
  double share = 1;
  for (Eigen::Index c = 0; c < unlimited_.size(); ++c) {
    if (unlimited_(c) != 0) share = std::min(share, range_towards(c, unlimited_(c)) / std::abs(unlimited_(c)));
  }
  return options_.strength * share * unlimited_;
}

TriangleFields Restoration::read_fields(const Vector& z) {
  ShapeOptimizer& optimizer = surface_.optimizer();
  TriangleFields result(optimizer.triangle_count(), 2 * optimizer.family_count());
  const Vector known = Vector::Ones(z.size());
  for (int k = 0; k < optimizer.family_count(); ++k)
    result.middleCols(2 * k, 2) = optimizer.evaluate_lines(z, known, k).target.gradient;
  return result;
}

Positions Restoration::lift(const Positions& V, const Vector& move) const {
  Positions result = V;
  for (Eigen::Index v = 0; v < V.rows(); ++v) {
    if (move(v) != 0) result.row(v) += move(v) * frame_.z().transpose();
  }
  return result;
}

// Finds the triangles (#F) that a move of the surface's vertices turns by more than kTurned.
Mask Restoration::find_turned(const Vector& move) const {
  const Triangles& F = surface_.triangles();
  const Positions before = triangle_normals(surface_.positions(), F),
                  after = triangle_normals(lift(surface_.positions(), move), F);
  Mask result(F.rows());
  for (Eigen::Index t = 0; t < F.rows(); ++t)
    result(t) = before.row(t).dot(after.row(t)) < std::cos(kTurned) * before.row(t).norm();
  return result;
}

// Returns the vertices (#V) of triangles (#F).
Mask Restoration::find_corners(const Mask& triangles) const {
  Mask result = Mask::Constant(surface_.positions().rows(), false);
  for (Eigen::Index t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3 && triangles(t); ++i) result(surface_.triangles()(t, i)) = true;
  }
  return result;
}

// Returns by how much a move changes theta, in the root mean square over area and lights, degrees.
double Restoration::measure_change(const Vector& move) {
  ShapeOptimizer& optimizer = surface_.optimizer();
  const Vector known = Vector::Ones(start_.size()), z = start_ + surface_.surface_move(move), area = optimizer.area();
  double squared = 0;
  for (int k = 0; k < optimizer.family_count(); ++k) {
    const Vector change =
        (optimizer.evaluate_lines(z, known, k).theta - optimizer.evaluate_lines(start_, known, k).theta)
            .unaryExpr([](double angle) { return wrap_angle(angle); });
    squared += area.dot(change.cwiseAbs2()) / (area.sum() * optimizer.family_count());
  }
  return std::sqrt(squared) * 180.0 / std::numbers::pi;
}

std::vector<LineScore> Restoration::score(const Vector& z) {
  ShapeOptimizer& optimizer = surface_.optimizer();
  const TriangleFields fields = read_fields(z);
  std::vector<LineScore> result;
  for (int k = 0; k < optimizer.family_count(); ++k)
    result.push_back(optimizer.score_field(fields.middleCols(2 * k, 2), report_.length, k));
  return result;
}

std::vector<double> Restoration::measure_unevenness(const Vector& z, const Vector& creases, Vector& stray,
                                                    std::vector<double>& typical) {
  const TriangleFields fields = read_fields(z);
  const TriangleFields off = fields - smoother_.smooth_with(creases, fields);
  stray = surface_.gather_faces(off.leftCols(2).rowwise().norm());
  const Vector area = surface_.optimizer().area();
  typical = find_medians(off, area);
  std::vector<double> result;
  for (Eigen::Index k = 0; k < off.cols(); k += 2) {
    const double squared = area.dot(off.middleCols(k, 2).rowwise().squaredNorm()) / area.sum();
    result.push_back(std::sqrt(squared) * report_.length * 180.0 / std::numbers::pi);
  }
  return result;
}

// Measures by the creases that both shapes have: the edge of a dent is one of the start only, and a new kink one of the
// result only. By those of the start, a dent of 2 % of the length counted as design, and its healing was refused.
void Restoration::measure_result(const Vector& move) {
  const Vector z = start_ + surface_.surface_move(move);
  common_creases_ = smoother_.find_creases(read_fields(z), progress(), creases_).cwiseMax(creases_);
  report_.unevenness_before = measure_unevenness(start_, common_creases_, stray_before_, typical_before_);
  report_.unevenness_after = measure_unevenness(z, common_creases_, report_.stray, typical_after_);
}

// Returns whether the shape that was measured last, with heights z (#V), has waves that are longer than the flaws.
bool Restoration::keeps_longer_waves(const Vector& z) {
  const TriangleFields fields = read_fields(z);
  const TriangleFields off = fields - smoother_.smooth_with(common_creases_, fields, kLongerReach);
  return has_longer_waves(typical_after_, find_medians(off, surface_.optimizer().area()), report_.length);
}

// Returns true where some light is more even than at the start, or noise fell.
bool Restoration::has_gain() const {
  for (size_t k = 0; k < report_.unevenness_after.size(); ++k) {
    if (report_.unevenness_after[k] < report_.unevenness_before[k]) return true;
  }
  return measure_gain(typical_before_, typical_after_) >= kLeastGain;
}

// Finds the light in which the lines became less even; -1 where there is none. A light may pay by kWorse for what is
// gained, and where nothing is, by nothing: a door glass with its mirror moved by half the limit, and both lights were
// less even by 0.01 %.
int Restoration::find_worse_light() const {
  const double most = report_.solve.converged() && has_gain() ? kWorse : 1.0;
  for (size_t k = 0; k < report_.unevenness_after.size(); ++k) {
    if (report_.unevenness_after[k] > most * report_.unevenness_before[k]) return static_cast<int>(k);
  }
  return -1;
}

SmoothPanelResult Restoration::judge(const Vector& move) {
  const Vector risen = surface_.surface_move(move);
  report_.score_before = score(start_);
  report_.score_after = score(start_ + risen);
  const bool turned = find_turned(risen).any();
  const int k = find_worse_light();
  if (turned || k >= 0) {
    report_.applied = false;
    report_.stray = stray_before_;
    report_.messages.push_back(
        turned ? "Nothing was changed: faces would have turned by more than 45 degrees. Select less."
               : "Nothing was changed: the lines would have become less even in one light (" +
                     degrees(report_.unevenness_before[k]) + " to " + degrees(report_.unevenness_after[k]) +
                     " degrees). Select less, or give a Length.");
    return {surface_.control_positions(), report_};
  }
  report_.largest_move = risen.cwiseAbs().maxCoeff();
  report_.largest_control_move = move.cwiseAbs().maxCoeff();
  // With twice the length clean bonnets and roofs, too, would be told to have waves that are longer.
  if (report_.length <= kAutomaticLength * diagonal_of(surface_.positions()))
    report_.longer_waves = keeps_longer_waves(start_ + risen);
  tell();
  return {lift(surface_.control_positions(), move), report_};
}

void Restoration::tell() {
  if (report_.limited > 0) {
    report_.messages.push_back("The limit of the move holds back " + count_of(report_.limited, "vertex", "vertices") +
                               "; what is deeper is left.");
  } else if (report_.largest_control_move == 0) {
    report_.messages.push_back(
        "No noise, ripples or dents were found: nothing was changed. Give a Length to smooth more.");
  }
  if (report_.longer_waves) {
    report_.messages.push_back(
        "Longer waves were left, for they may be design: with twice the Flaw Size they count as flaws, too.");
  }
  if (!report_.solve.converged()) {
    report_.messages.push_back(
        "The solver stopped before its end; the lines are more even in every light all the same. Select less to let it "
        "finish.");
  }
  if (report_.held_faces > 0) {
    report_.messages.push_back(count_of(report_.held_faces, "face was", "faces were") +
                               " left alone that would have turned by more than 45 degrees.");
  }
}

}  // namespace reflines
