#include "restoration/followed_border.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "restoration/control_range.h"
#include "restoration/controlled_surface.h"
#include "restoration/held_border.h"
#include "restoration/joined_mesh.h"
#include "restoration/joined_options.h"
#include "restoration/press_rules.h"
#include "restoration/region_result.h"
#include "restoration/restoration.h"
#include "restoration/tangent_match.h"

namespace reflines {
namespace {

// Returns the options of the joined mesh: the region's border is as it was, but where it is followed no border.
ShapeOptions join_followed(const ShapeOptions& own, const Mask& region_free, const JoinedMesh& joined,
                           Eigen::Index region_triangles) {
  ShapeOptions result = join_shape(own, region_free, joined, region_triangles, BesideRegion::kStays);
  result.border = own.border;
  result.border.resize(joined.V.rows(), Border::kClamped);
  return result;
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
    const ControlRange range(limit, amount.limit_range, V_.rows());
    const PressAmount joined_amount = join_amount(amount, limit, joined_.V.rows() - V_.rows());
    const Vector turned = pad(turn(range, limit, Vector::Zero(V_.rows()), kRules.border.turned_before));
    begin(turned);
    Vector move = turned + press_->find_move(begin_after(joined_amount, turned));
    move += pad(turn(range, limit, move.head(V_.rows()), kRules.border.turned_after));
    const SmoothPanelResult judged = press_->judge(amount.strength * (move - turned), true);
    if (!judged.report.applied || has_worse_place(judged.report.healed)) return press_clamped(amount);
    return take_region({judged, V_, range, region_.optimizer().region(), alone_.report().limit}, match_,
                       amount.strength * move.head(V_.rows()), amount.strength * turned.head(V_.rows()));
  }

 private:
  Vector pad(const Vector& move) const {
    Vector result = Vector::Zero(joined_.V.rows());
    result.head(move.size()) = move;
    return result;
  }

  // Returns by how much more the region's vertices (#V) are to move, so that the border's tangents are those beside it.
  Vector turn(const ControlRange& range, double limit, const Vector& move, double width) const {
    Vector change = match_tangents(match_, move, width * alone_.report().length, limit);
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

  SmoothPanelResult press_clamped(const PressAmount& amount) {
    if (!clamped_) clamped_ = prepare_held_border(V_, F_, view_, families_, clamp_followed(own_), options_);
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
  if (joined.V.rows() == V.rows()) return prepare_held_border(V, F, view, families, clamp_followed(own), options);
  return std::make_unique<FollowedBorderPress>(V, F, view, families, own, std::move(joined), options);
}

}  // namespace reflines
