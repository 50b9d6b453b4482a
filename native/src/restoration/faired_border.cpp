#include "restoration/faired_border.h"

#include <utility>

#include "geometry/mesh.h"
#include "reflines/errors.h"
#include "restoration/controlled_surface.h"
#include "restoration/held_border.h"
#include "restoration/joined_mesh.h"
#include "restoration/joined_options.h"
#include "restoration/restoration.h"

namespace reflines {
namespace {

// Returns the border with the vertices free that are to be faired.
std::vector<Border> free_border(const ShapeOptions& shape, const Mask& faired) {
  std::vector<Border> result = shape.border;
  if (result.empty()) result.assign(faired.size(), Border::kClamped);
  for (Eigen::Index v = 0; v < faired.size(); ++v) {
    if (faired(v)) result[v] = Border::kFree;
  }
  return result;
}

// Tells that the whole border was held, after the note that comes first; see SmoothPanelReport::notes.
void tell_held(SmoothPanelReport& report) {
  const bool has_first = !report.applied || report.limited > 0 || report.largest_control_move == 0;
  report.notes.insert(report.notes.begin() + has_first, {NoteKind::kNotFaired});
}

// Presses the border as it is held, and tells so.
class UnfairedPress : public Press {
 public:
  explicit UnfairedPress(std::unique_ptr<Press> press) : press_(std::move(press)) {}

  SmoothPanelResult run(const PressAmount& amount) override {
    SmoothPanelResult result = press_->run(amount);
    tell_held(result.report);
    return result;
  }

 private:
  std::unique_ptr<Press> press_;
};

// Finds the move on the joined mesh, and judges it on the region.
class FairedBorderPress : public Press {
 public:
  // `own` are the options of the region with its border free, `wanted` (#V) the vertices to be faired.
  FairedBorderPress(std::unique_ptr<MeshSurface> region, std::unique_ptr<Restoration> judge, const JoinedMesh& joined,
                    const Vector3& view, const std::vector<Vector3>& families, const ShapeOptions& joined_shape,
                    const SmoothPanelOptions& options, const Mask& wanted)
      : region_(std::move(region)),
        judge_(std::move(judge)),
        surface_(joined.V, joined.F, view, families, joined_shape),
        press_(surface_, join_options(options, judge_->report().length, joined_shape.partner)),
        held_(wanted && !surface_.optimizer().free().head(wanted.size())) {}

  const Mask& held() const { return held_; }  // #V: vertices to be faired that are held all the same

  SmoothPanelResult run(const PressAmount& amount) override {
    const Eigen::Index own = held_.size(), beside = surface_.positions().rows() - own;
    judge_->choose(amount);
    Vector move = press_.find_move(join_amount(amount, judge_->report().limit, beside));
    move.tail(beside).setZero();
    if (press_.turns_faces(move)) {
      throw SolverFailure(
          "Faces at the border would have turned by more than 45 degrees, so nothing was changed; hold the border, or "
          "give a smaller limit.");
    }
    SmoothPanelResult result = judge_->judge_move(move.head(own), press_.report(), press_.limited().head(own),
                                                  press_.held_triangles().head(region_->triangles().rows()));
    result.report.work += press_.take_work();
    if (held_.any()) result.report.notes.push_back({NoteKind::kPartlyFaired, static_cast<int>(held_.count())});
    return result;
  }

 private:
  std::unique_ptr<MeshSurface> region_;
  std::unique_ptr<Restoration> judge_;
  MeshSurface surface_;  // of the joined mesh
  Restoration press_;
  Mask held_;
};

}  // namespace

std::unique_ptr<Press> prepare_faired_border(const Positions& V, const Triangles& F, const Vector3& view,
                                             const std::vector<Vector3>& families, const ShapeOptions& shape,
                                             const SmoothPanelOptions& options) {
  ShapeOptions own = shape;
  own.border = free_border(shape, options.fair_border);
  own.around = {};
  auto region = std::make_unique<MeshSurface>(V, F, view, families, own);
  auto judge = std::make_unique<Restoration>(*region, options);
  const Mask movable = region->optimizer().free();
  const Mask wanted = movable && options.fair_border && find_border_vertices(F, static_cast<int>(V.rows()));
  if (!wanted.any()) return prepare_held_border(V, F, view, families, shape, options);
  const JoinedMesh joined = join_surroundings(V, F, shape.around, kFairMargin * judge->report().length);
  const ShapeOptions joined_shape = join_shape(own, movable, joined, F.rows(), BesideRegion::kMoves);
  auto press = std::make_unique<FairedBorderPress>(std::move(region), std::move(judge), joined, view, families,
                                                   joined_shape, options, wanted);
  if (press->held().count() < wanted.count()) return press;
  return std::make_unique<UnfairedPress>(prepare_held_border(V, F, view, families, shape, options));
}

}  // namespace reflines
