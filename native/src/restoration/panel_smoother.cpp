#include "reflines/panel_smoother.h"

#include <memory>
#include <utility>
#include <vector>

#include "reflines/errors.h"
#include "restoration/faired_border.h"
#include "restoration/followed_border.h"
#include "restoration/held_border.h"
#include "restoration/parted_region.h"
#include "restoration/press.h"
#include "restoration/press_checks.h"
#include "restoration/press_rules.h"
#include "restoration/press_setup.h"
#include "restoration/used_vertices.h"
#include "solver/limited_move.h"
#include "solver/mirror_coupling.h"
#include "solver/solve_checks.h"
#include "threads/abandonable_work.h"

namespace reflines {
namespace {

// Presses the vertices that are in faces; the others keep their bits.
class MeshPress : public Press {
 public:
  MeshPress(Positions V, const Triangles& F, const Vector3& view, const Vector3& lines,
            const SmoothPanelOptions& options, const PressAmount& amount)
      : V_(std::move(V)), used_(find_used_vertices(F, static_cast<int>(V_.rows()))) {
    ShapeOptions shape = choose_shape(used_, options, V_.rows());
    set_restoration_rules(options, lines, amount, kRules.proximity, shape);
    partner_ = shape.partner;
    SmoothPanelOptions own = options;
    own.partner = partner_;
    if (own.fair_border.size() > 0) own.fair_border = options.fair_border(used_.index);
    const Positions used = V_(used_.index, Eigen::all);
    const std::vector<Vector3> families = make_families(view, lines, options);
    const auto prepare = own.fair_border.any()   ? prepare_faired_border
                         : follows(shape.border) ? prepare_followed_border
                                                 : prepare_held_border;
    press_ = prepare(used, used_.F, view, families, shape, own);
  }

  SmoothPanelResult run(const PressAmount& amount) override {
    PressAmount own = amount;
    if (amount.limit_range.exists())
      own.limit_range = {amount.limit_range.lowest(used_.index), amount.limit_range.highest(used_.index)};
    own.limit_range = intersect_limits(own.limit_range, partner_);
    SmoothPanelResult result = press_->run(own);
    Positions all = V_;
    all(used_.index, Eigen::all) = result.positions;
    result.positions = std::move(all);
    return result;
  }

 private:
  Positions V_;
  UsedVertices used_;
  IndexVector partner_;  // of the used vertices
  std::unique_ptr<Press> press_;
};

std::unique_ptr<Press> prepare_mesh(const Positions& V, const Triangles& F, const Vector3& view, const Vector3& lines,
                                    const SmoothPanelOptions& options, const PressAmount& amount) {
  const PreparePress prepare_whole = [=] { return std::make_unique<MeshPress>(V, F, view, lines, options, amount); };
  std::unique_ptr<Press> parted = prepare_parted_region(V, F, view, lines, options, amount, prepare_whole);
  return parted ? std::move(parted) : prepare_whole();
}

}  // namespace

PressAmount amount_of(const SmoothPanelOptions& options) {
  return {options.strength, options.limit, options.limit_range, options.progress};
}

PanelSmoother::PanelSmoother(const Positions& V, const Triangles& F, const Vector3& view_direction,
                             const Vector3& line_direction, const SmoothPanelOptions& options)
    : control_count_(V.rows()), prepare_([=](const PressAmount& amount) {
        return prepare_mesh(V, F, view_direction, line_direction, options, amount);
      }) {
  check_press_options(options, V.rows());
  check_surroundings(options.around, V.rows());
  check_partners(options.partner, V.rows());
  check_surface(V, F);
  check_face_of_triangle(options.face_of_triangle, F.rows());
}

PanelSmoother::PanelSmoother(const Cage& cage, const Positions& V, const Vector3& view_direction,
                             const Vector3& line_direction, const CageOptions& cage_options,
                             const SmoothPanelOptions& options)
    : control_count_(V.rows()), prepare_([=](const PressAmount& amount) {
        return prepare_cage({cage, V, cage_options}, view_direction, line_direction, options, amount);
      }) {
  check_press_options(options, V.rows());
  if (options.fair_border.any())
    throw InvalidInput("The border of a cage cannot be faired: only that of a mesh, by the faces beside it.");
}

// Presses with work that owns all that it uses: a cancelled press goes on for a while on a thread of its own (see
// run_abandonable), and the next one begins anew.
SmoothPanelResult PanelSmoother::press(const PressAmount& amount) {
  check_amount(amount, control_count_);
  struct Work {
    std::shared_ptr<Press> press;
    SmoothPanelResult result;
  };
  const auto work = std::make_shared<Work>(Work{std::exchange(press_, nullptr), {}});
  run_abandonable(amount.progress.get(), [work, amount, prepare = prepare_] {
    if (!work->press) work->press = prepare(amount);
    work->result = work->press->run(amount);
  });
  press_ = work->press;
  return std::move(work->result);
}

SmoothPanelResult smooth_panel(const Positions& V, const Triangles& F, const Vector3& view_direction,
                               const Vector3& line_direction, const SmoothPanelOptions& options) {
  return PanelSmoother(V, F, view_direction, line_direction, options).press(amount_of(options));
}

SmoothPanelResult smooth_cage_panel(const Cage& cage, const Positions& V, const Vector3& view_direction,
                                    const Vector3& line_direction, const CageOptions& cage_options,
                                    const SmoothPanelOptions& options) {
  return PanelSmoother(cage, V, view_direction, line_direction, cage_options, options).press(amount_of(options));
}

}  // namespace reflines
