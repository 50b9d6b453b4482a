#include "restoration/joint_side.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

#include "geometry/bounding_box.h"
#include "geometry/mesh.h"
#include "geometry/open_border.h"
#include "restoration/even_flush.h"
#include "restoration/followed_border.h"
#include "restoration/held_border.h"
#include "restoration/joined_options.h"
#include "restoration/press_notes.h"
#include "restoration/press_rules.h"
#include "restoration/press_setup.h"
#include "restoration/region_result.h"
#include "restoration/rim_spread.h"
#include "restoration/soft_step.h"
#include "solver/mirror_coupling.h"

namespace reflines {
namespace {

constexpr double kHeldByCage = 1e-9;  // influence of the free vertices of a cage
constexpr double kLeastFacing = 0.3;  // cosine of 73 degrees between view and normal: what is steeper moves no further
constexpr double kWhole = std::numeric_limits<double>::infinity();

// Puts two kinds of surroundings of one region with `own` vertices together.
Surroundings combine(const Surroundings& one, const Surroundings& other, Eigen::Index own) {
  Surroundings result;
  result.V.resize(one.V.rows() + other.V.rows(), 3);
  result.V << one.V, other.V;
  const auto shift = static_cast<int>(one.V.rows());
  result.F.resize(one.F.rows() + other.F.rows(), 3);
  result.F << one.F, other.F.unaryExpr([&](int v) { return v < own ? v : v + shift; });
  return result;
}

// Returns a change with the mean of both mirror images for each.
Vector mirror_alike(const IndexVector& partner, Vector change) {
  for (int v = 0; v < partner.size(); ++v) {
    const int other = partner(v);
    if (other > v) change(v) = change(other) = 0.5 * (change(v) + change(other));
  }
  return change;
}

}  // namespace

JointSide::JointSide(const CagePanel& panel, const PressAmount& amount)
    : panel_(panel.panel),
      corner_(panel.corner),
      used_(find_used_vertices(panel_.F, static_cast<int>(panel_.V.rows()))),
      V_(panel_.V(used_.index, Eigen::all)),
      F_(used_.F),
      families_(make_families(panel_.view_direction, panel_.line_direction, panel_.options)),
      shape_(choose_shape(used_, panel_.options, panel_.V.rows())),
      options_(panel_.options),
      gap_(panel_.gap.gap > 0 ? panel_.gap.gap : kAutomaticGap * bounding_box_diagonal(V_)),
      joint_(Mask::Constant(V_.rows(), false)),
      still_(joint_),
      rim_(find_border_edges(F_, edge_neighbors(F_))),
      rim_tree_(V_, rim_) {
  set_restoration_rules(options_, panel_.line_direction, amount, kRules.proximity, shape_);
  options_.partner = shape_.partner;
}

Eigen::AlignedBox3d JointSide::box() const {
  return {V_.colwise().minCoeff().transpose(), V_.colwise().maxCoeff().transpose()};
}

void JointSide::widen_flaws(double diagonal) {
  joint_options_ = options_;
  widened_ = std::clamp(diagonal / bounding_box_diagonal(V_), 1.0, kRules.joint.widened);
  joint_options_.flaw_size *= widened_;
}

GapContinuation JointSide::continue_region(const Positions& V, const Surroundings& around, const Skin& beside,
                                           double margin) const {
  return continue_over_gap(V, F_, around, beside.V, beside.F, {gap_, margin});
}

GapContinuation JointSide::take_around() const {
  GapContinuation rings{
      .around = shape_.around, .followed = Mask::Constant(V_.rows(), false), .width = {}, .flush = {}};
  for (const int v : shape_.around.F.reshaped()) {
    if (v < V_.rows()) rings.followed(v) = true;
  }
  return rings;
}

void JointSide::face(const Skin& others) {
  if (!follows(shape_.border)) return;
  Mask wanted(V_.rows());
  for (Eigen::Index v = 0; v < wanted.size(); ++v) wanted(v) = shape_.border[v] == Border::kFollow;
  const GapContinuation joint = continue_region(V_, shape_.around, others, panel_.gap.margin);
  joint_ = joint.followed && wanted;
  rings_still_ = panel_.around_is_followed ? take_around()
                                           : continue_region(V_, combine(shape_.around, joint.around, V_.rows()),
                                                             {panel_.V_beside, panel_.F_beside}, panel_.gap.margin);
  still_ = rings_still_.followed && wanted && !joint_;
  own_ = leave_surroundings(shape_);
  turned_border_ = own_.border;
  for (Eigen::Index v = 0; v < wanted.size(); ++v) {
    if (wanted(v) && !joint_(v) && !still_(v)) own_.border[v] = turned_border_[v] = Border::kClamped;
    if (joint_(v)) own_.border[v] = Border::kFree;
  }
}

ShapeOptions JointSide::clamp_joint() const {
  ShapeOptions result = shape_;
  for (Eigen::Index v = 0; v < still_.size(); ++v) {
    if (!still_(v) && result.border.size() > 0 && result.border[v] == Border::kFollow)
      result.border[v] = Border::kClamped;
  }
  if (still_.any()) result.around = rings_still_.around;
  return result;
}

SmoothPanelResult JointSide::press_alone(const PressAmount& amount) {
  if (is_cage()) {
    if (!other_)
      other_ = prepare_cage(*panel_.cage, panel_.view_direction, panel_.line_direction, panel_.options, amount);
    return other_->run(amount);
  }
  const ShapeOptions shape = clamp_joint();
  const auto prepare = follows(shape.border) ? prepare_followed_border : prepare_held_border;
  if (!other_) other_ = prepare(V_, F_, panel_.view_direction, families_, shape, options_);
  return other_->run(amount);
}

SmoothPanelResult JointSide::press_clamped(const PressAmount& amount) {
  SmoothPanelResult result = press_alone(amount);
  result.report.notes.push_back({NoteKind::kJoiningWorsens});
  return result;
}

void JointSide::build_region() {
  if (is_cage()) {
    JointCage own = free_border(*panel_.cage, corner_, joint_);
    set_restoration_rules(options_, panel_.line_direction, {}, kRules.cage.proximity, own.options.shape);
    cage_ = std::make_unique<CageControlledSurface>(own.cage, own.V, panel_.view_direction, families_, own.options);
    const Vector fraction = cage_->surface_move(cage_->control_free().cast<double>());
    own_.held = fraction.array() < kHeldByCage;
  }
  region_ = std::make_unique<MeshSurface>(V_, F_, panel_.view_direction, families_, own_);
  alone_ = std::make_unique<Restoration>(*region_, joint_options_);
  free_ = region_->optimizer().free();
  joint_ = joint_ && free_;
}

void JointSide::begin(const PressAmount& amount) {
  if (!region_) build_region();
  alone_->choose(amount);
  const double limit = alone_->report().limit;
  range_ = std::make_unique<ControlRange>(limit, is_cage() ? MoveLimit{} : amount.limit_range, V_.rows());
  if (is_cage()) control_range_ = std::make_unique<ControlRange>(limit, amount.limit_range, panel_.cage->V.rows());
  firm_ = false;
  move_ = turned_ = evened_ = Vector::Zero(V_.rows());
}

Positions JointSide::present(double fraction) const {
  if (move_.size() == 0) return V_;
  return V_ + fraction * move_ * axis().transpose();
}

Skin JointSide::skin(double fraction) const { return {present(fraction), F_}; }

UnevenFlush JointSide::find_uneven_flush(const Skin& others, const FlushPart& part, double fraction) const {
  const Positions V = present(fraction);
  const Positions normal = find_open_border(V, F_, shape_.around).normal;
  const GapContinuation found = continue_region(V, shape_.around, others, 0);
  const double least = kRules.bump.least_height * alone_->report().length;
  UnevenFlush result{0, Vector::Zero(V.rows())};
  const IndexVector across = found.followed.select(part.across.array(), -1);
  for (const RimRun& run : find_rim_runs(V, rim_, across)) {
    const Vector uneven = reflines::find_uneven_flush(V, run, found.flush);
    const double most = uneven.cwiseAbs().maxCoeff();
    const double seen = soft_step(least, most);
    result.most = std::max(result.most, most);
    for (size_t k = 0; k < run.vertices.size(); ++k) {
      const int v = run.vertices[k];
      const double facing = std::max(normal.row(v).dot(axis()), kLeastFacing);
      result.change(v) = part.taken(v) * seen * uneven(static_cast<Eigen::Index>(k)) / facing;
    }
  }
  return result;
}

JoinedMesh JointSide::join(const Positions& V, const Skin& others) const {
  const GapContinuation rings = continue_region(V, shape_.around, others, widened_ * panel_.gap.margin);
  return join_surroundings(V, F_, combine(rings.around, rings_still_.around, V.rows()), kWhole);
}

Turn JointSide::find_turn(const Skin& others, double lengths) const {
  const Positions V = present(1);
  const JoinedMesh joined = join(V, others);
  Vector fraction = Vector::Ones(V.rows());
  fraction = joint_.select(0.5 * fraction.array(), fraction.array());
  const TangentMatch match{joined, V.rows(), F_.rows(), turned_border_, region_->optimizer().frame(), fraction};
  const double width = lengths * alone_->report().length / widened_;
  const Vector change = match_tangents(match, Vector::Zero(V.rows()), width, alone_->report().limit);
  return {change, reflines::find_turn(match, change)};
}

void JointSide::add(const Vector& change) {
  const Vector moved = free_.select(mirror_alike(shape_.partner, change).array(), 0.0);
  move_ = range_->cut(move_ + moved);
}

void JointSide::begin_evened(const Vector& change) {
  const double width = kRules.border.turned_before * alone_->report().length / widened_;
  move_.setZero();
  add(spread_from_rim(region_->optimizer().frame().project(V_), rim_, change, width,
                      [&](double distance) { return fade(distance / width); }));
  turned_ = evened_ = move_;
}

void JointSide::begin_turned(const Vector& change) {
  move_ = evened_;
  add(change);
  turned_ = move_;
}

void JointSide::turn_after(const Vector& change) { add(change); }

// Returns the options of the joined mesh: the others' continuation moves, what stays does.
ShapeOptions JointSide::choose_joined_shape(const JoinedMesh& joined) const {
  ShapeOptions result = join_shape(own_, free_, joined, F_.rows(), BesideRegion::kMoves);
  result.border = own_.border;
  for (Eigen::Index v = 0; v < joint_.size(); ++v) {
    if (joint_(v)) result.border[v] = Border::kClamped;  // where a ring of its own is of no use
  }
  result.border.resize(joined.V.rows(), Border::kClamped);
  std::set<std::array<double, 3>> still;
  for (const auto& p : rings_still_.around.V.rowwise()) still.insert({p.x(), p.y(), p.z()});
  for (Eigen::Index v = V_.rows(); v < joined.V.rows(); ++v)
    result.held(v) = still.contains({joined.V(v, 0), joined.V(v, 1), joined.V(v, 2)});
  return result;
}

void JointSide::press(const Skin& others, const PressAmount& amount) {
  JoinedMesh joined = join(present(1), others);
  const bool same = press_ && joined.V.rows() == joined_.V.rows() && joined.V == joined_.V && joined.F == joined_.F;
  if (!same) {
    press_.reset();  // it refers to the surface
    joined_ = std::move(joined);
    const ShapeOptions shape = choose_joined_shape(joined_);
    surface_ = std::make_unique<MeshSurface>(joined_.V, joined_.F, panel_.view_direction, families_, shape);
    press_ =
        std::make_unique<Restoration>(*surface_, join_options(joint_options_, alone_->report().length, shape.partner));
  }
  PressAmount unlimited = {.strength = 1, .limit = kNoLimit, .limit_range = {}, .progress = amount.progress};
  const Vector found = press_->find_move(unlimited);
  move_ = turned_ + found.head(V_.rows());
  beside_ = found.tail(joined_.V.rows() - V_.rows());
  if (is_cage()) gain_ = weigh_gain();
}

// Returns the fraction that a cage makes of its move, by what it can take of that.
double JointSide::weigh_gain() const {
  Vector move(joined_.V.rows());
  move << cage_->surface_move(cage_->fit(move_)) - turned_, beside_;
  return press_->weigh_gain(move);
}

void JointSide::even(const Vector& change) {
  Vector values = Vector::Zero(joined_.V.rows());
  values.head(V_.rows()) = mirror_alike(shape_.partner, change);
  const double width = kRules.border.turned_after * alone_->report().length;
  const Vector spread = spread_from_rim(region_->optimizer().frame().project(joined_.V), rim_, values, width,
                                        [&](double distance) { return fade(distance / width); });
  move_ += free_.select(spread.head(V_.rows()).array(), 0.0).matrix();
  limited_ = static_cast<int>(range_->find_beyond(move_).count());
  beside_ += surface_->optimizer().free().select(spread.array(), 0.0).matrix().tail(beside_.size());
}

void JointSide::saturate() {
  move_ = range_->saturate(move_);
  beside_ = ControlRange(alone_->report().limit, {}, beside_.size()).saturate(beside_);
}

void JointSide::take_shape() {
  const double fraction = std::exchange(gain_, 1.0);
  control_ = fraction * cage_->fit(move_);
  limited_ = static_cast<int>(control_range_->find_beyond(control_).count());
  if (limited_ > 0) control_ = control_range_->saturate(control_);
  move_ = cage_->surface_move(control_);
}

// Returns the result for a cage from that for its surface.
SmoothPanelResult JointSide::read_cage(SmoothPanelResult surface, const PressAmount& amount) const {
  const Vector move = amount.strength * control_;
  SmoothPanelReport& report = surface.report;
  surface.positions = control_range_->apply(panel_.cage->V, axis(), move);
  report.largest_control_move = move.cwiseAbs().maxCoeff();
  for (Vector* values : {&report.line_deviation, &report.verdict}) {
    if (values->size() > 0) *values = cage_->gather_faces(*values);
  }
  return surface;
}

SmoothPanelResult JointSide::judge(const PressAmount& amount) {
  Vector move(joined_.V.rows());
  move << move_ - turned_, beside_;
  SmoothPanelResult judged = press_->judge(amount.strength * move, true);
  if (!judged.report.applied) return judged;
  judged.report.limited = limited_;
  if (limited_ > 0) judged.report.notes = tell_result(judged.report);
  const TangentMatch match{joined_, V_.rows(), F_.rows(), turned_border_, region_->optimizer().frame()};
  SmoothPanelResult own = take_region({judged, V_, *range_, region_->optimizer().region(), alone_->report().limit},
                                      match, amount.strength * move_, amount.strength * turned_);
  return is_cage() ? read_cage(std::move(own), amount) : own;
}

RimPlace JointSide::find_rim(const Vector3& point, double within) const {
  const NearestPoint nearest = rim_tree_.find(point, within);
  if (nearest.triangle < 0) return {kWhole, -1, -1, 0};
  const int a = rim_(nearest.triangle, 0), b = rim_(nearest.triangle, 1);
  const Vector3 first = V_.row(a), second = V_.row(b);
  const double fraction = (nearest.point - first).norm() / std::max((second - first).norm(), 1e-300);
  return {nearest.distance, a, b, fraction};
}

}  // namespace reflines
