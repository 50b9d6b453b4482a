#include "restoration/followed_border.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "restoration/control_range.h"
#include "restoration/controlled_surface.h"
#include "restoration/held_border.h"
#include "restoration/joined_mesh.h"
#include "restoration/joined_options.h"
#include "restoration/press_notes.h"
#include "restoration/restoration.h"
#include "restoration/tangent_match.h"

namespace reflines {
namespace {

// Lengths over which the border's tangents are turned: before a press far enough that it finds nothing to heal in that,
// and after it over less, since what a neighbour's flaws turn is not to be spread. Of a dent across the gap 0.24
// degrees are left so, and 0.32 with two lengths.
constexpr double kReachBefore = 2.0, kReachAfter = 1.0;

// The factor of the worst deviation of lines before, and the degrees of it, from which on a result has a worse place.
constexpr double kWorsePlace = 1.05, kLeastWorst = 0.3;

constexpr double kToldTurn = 0.3;  // degrees of the border's tangents that are worth a word

// Returns the options of the region alone: nothing but the neighbours that are joined with it tells what lies beside.
ShapeOptions leave_surroundings(const ShapeOptions& shape) {
  ShapeOptions result = shape;
  for (Border& border : result.border) {
    if (continues_lines(border)) border = Border::kClamped;
  }
  result.around = {};
  return result;
}

ShapeOptions clamp_instead(ShapeOptions shape) {
  std::replace(shape.border.begin(), shape.border.end(), Border::kFollow, Border::kClamped);
  return shape;
}

// Returns the options of the joined mesh: the region's border is as it was, but where it is followed no border.
ShapeOptions join_followed(const ShapeOptions& own, const Mask& region_free, const JoinedMesh& joined,
                           Eigen::Index region_triangles) {
  ShapeOptions result = join_shape(own, region_free, joined, region_triangles, BesideRegion::kStays);
  result.border = own.border;
  result.border.resize(joined.V.rows(), Border::kClamped);
  return result;
}

// Returns the amount of a press, with the whole strength, that begins where vertices (of the joined mesh) have moved
// already, so that both moves together stay within the limit.
PressAmount begin_after(const PressAmount& amount, const Vector& move) {
  PressAmount result = amount;
  result.strength = 1;
  if (move.isZero(0)) return result;
  const Vector share = move / amount.limit;
  if (!result.limit_share.exists()) result.limit_share = MoveLimit::within(1, static_cast<int>(move.size()));
  result.limit_share.lowest = (result.limit_share.lowest - share).cwiseMax(-1).cwiseMin(0);
  result.limit_share.highest = (result.limit_share.highest - share).cwiseMin(1).cwiseMax(0);
  return result;
}

// Returns whether some place of the result is worse than the worst one before. Where a bent border meets one that is
// held, the turned tangents of the one and those of the other make a curl in the corner.
bool has_worse_place(const HealedFlaws& healed) {
  return healed.worst_after > kWorsePlace * std::max(healed.worst_before, kLeastWorst);
}

class FollowedBorderPress : public Press {
 public:
  // `own` are the options of the region alone.
  FollowedBorderPress(const Positions& V, const Triangles& F, const Vector3& view, std::vector<Vector3> families,
                      const ShapeOptions& own, JoinedMesh joined, const SmoothPanelOptions& options)
      : V_(V),
        F_(F),
        view_(view),
        families_(std::move(families)),
        own_(own),
        options_(options),
        joined_(std::move(joined)),
        region_(V, F, view, families_, own),
        alone_(region_, options),
        free_(region_.optimizer().free()),
        match_{joined_, V.rows(), F.rows(), own_.border, region_.optimizer().frame()},
        joined_shape_(join_followed(own, free_, joined_, F.rows())),
        joined_options_(join_options(options, alone_.report().length, joined_shape_.partner)) {}

  SmoothPanelResult run(const PressAmount& wanted) override {
    PressAmount amount = wanted;
    amount.judged = true;  // the measures choose between the borders
    alone_.choose(amount);
    const double limit = alone_.report().limit;
    const ControlRange range(limit, amount.limit_share, V_.rows());
    const PressAmount joined_amount = join_amount(amount, limit, joined_.V.rows() - V_.rows());
    const Vector turned = pad(turn(range, limit, Vector::Zero(V_.rows()), kReachBefore));
    begin(turned);
    Vector move = turned + press_->find_move(begin_after(joined_amount, turned));
    move += pad(turn(range, limit, move.head(V_.rows()), kReachAfter));
    const SmoothPanelResult judged = press_->judge(amount.strength * (move - turned));
    if (!judged.report.applied || has_worse_place(judged.report.healed)) return press_clamped(amount);
    return take_region(judged, range, amount.strength * move.head(V_.rows()), amount.strength * turned.head(V_.rows()));
  }

 private:
  Vector pad(const Vector& move) const {
    Vector result = Vector::Zero(joined_.V.rows());
    result.head(move.size()) = move;
    return result;
  }

  // Returns by how much more the region's vertices (#V) are to move, so that the border's tangents are those beside it.
  Vector turn(const ControlRange& range, double limit, const Vector& move, double reach) const {
    Vector change = match_tangents(match_, move, reach * alone_.report().length, limit);
    for (int v = 0; v < own_.partner.size(); ++v) {
      const int other = own_.partner(v);
      if (other > v) change(v) = change(other) = 0.5 * (change(v) + change(other));
    }
    const Vector whole = move + free_.select(change.array(), 0.0).matrix();
    return range.cut(whole) - move;
  }

  // Prepares the press of the mesh with the tangents turned, unless it is there already.
  void begin(const Vector& turned) {
    if (press_ && turned == turned_) return;
    press_.reset();  // it refers to the surface
    surface_ = std::make_unique<MeshSurface>(joined_.V + turned * match_.frame.z().transpose(), joined_.F, view_,
                                             families_, joined_shape_);
    press_ = std::make_unique<Restoration>(*surface_, joined_options_);
    turned_ = turned;
  }

  // Returns the result for the region alone after a move of its vertices (#V), of which `turned` turned the border.
  SmoothPanelResult take_region(const SmoothPanelResult& joined, const ControlRange& range, const Vector& move,
                                const Vector& turned) {
    SmoothPanelResult result{range.apply(V_, match_.frame.z(), move), joined.report};
    SmoothPanelReport& report = result.report;
    report.stray = joined.report.stray.head(F_.rows()).eval();
    report.region = region_.optimizer().region();
    report.limit = alone_.report().limit;
    report.largest_move = report.largest_control_move = move.cwiseAbs().maxCoeff();
    if (!turned.isZero(0)) report.notes = tell_result(report);
    const double angle = find_turn(match_, turned);
    if (angle >= kToldTurn) report.notes.push_back({.kind = NoteKind::kBorderTurned, .after = angle});
    return result;
  }

  SmoothPanelResult press_clamped(const PressAmount& amount) {
    if (!clamped_) clamped_ = prepare_held_border(V_, F_, view_, families_, clamp_instead(own_), options_);
    SmoothPanelResult result = clamped_->run(amount);
    result.report.notes.push_back({NoteKind::kFollowingWorsens});
    return result;
  }

  Positions V_;
  Triangles F_;
  Vector3 view_;
  std::vector<Vector3> families_;
  ShapeOptions own_;
  SmoothPanelOptions options_;
  JoinedMesh joined_;
  MeshSurface region_;
  Restoration alone_;  // tells length and limit
  Mask free_;          // #V
  TangentMatch match_;
  ShapeOptions joined_shape_;
  SmoothPanelOptions joined_options_;
  std::unique_ptr<MeshSurface> surface_;  // of the joined mesh, its border's tangents turned
  std::unique_ptr<Restoration> press_;
  Vector turned_;
  std::unique_ptr<Press> clamped_;
};

}  // namespace

bool follows(const std::vector<Border>& border) {
  return std::find(border.begin(), border.end(), Border::kFollow) != border.end();
}

std::unique_ptr<Press> prepare_followed_border(const Positions& V, const Triangles& F, const Vector3& view,
                                               const std::vector<Vector3>& families, const ShapeOptions& shape,
                                               const SmoothPanelOptions& options) {
  const ShapeOptions own = leave_surroundings(shape);
  JoinedMesh joined = join_surroundings(V, F, shape.around, std::numeric_limits<double>::infinity());
  if (joined.V.rows() == V.rows()) return prepare_held_border(V, F, view, families, clamp_instead(own), options);
  return std::make_unique<FollowedBorderPress>(V, F, view, families, own, std::move(joined), options);
}

}  // namespace reflines
