#include "reflines/joint_smoother.h"

#include <utility>

#include "geometry/mesh.h"
#include "reflines/errors.h"
#include "restoration/joint_press.h"
#include "restoration/press_checks.h"
#include "solver/mirror_coupling.h"
#include "solver/solve_checks.h"
#include "threads/abandonable_work.h"

namespace reflines {
namespace {

Eigen::Index count_vertices(const JointPanel& panel) { return panel.cage ? panel.cage->V.rows() : panel.V.rows(); }

void check(const JointPanel& panel) {
  if (panel.cage) return check_press_options(panel.options, panel.cage->V.rows());
  check_press_options(panel.options, panel.V.rows());
  check_surroundings(panel.options.around, panel.V.rows());
  check_partners(panel.options.partner, panel.V.rows());
  check_surface(panel.V, panel.F);
  check_face_of_triangle(panel.options.face_of_triangle, panel.F.rows());
  if (panel.options.fair_border.any())
    throw InvalidInput("The border of several panels cannot be faired: only that of one, by the faces beside it.");
}

}  // namespace

JointSmoother::JointSmoother(std::vector<JointPanel> panels) : panels_(std::move(panels)) {
  if (panels_.empty()) throw InvalidInput("There are no panels to press.");
  for (const JointPanel& panel : panels_) check(panel);
}

JointSmoother::~JointSmoother() = default;

// Presses with work that owns all that it uses, as PanelSmoother::press does.
std::vector<SmoothPanelResult> JointSmoother::press(const std::vector<PressAmount>& amounts) {
  if (amounts.size() != panels_.size()) throw InvalidInput("Each panel needs an amount of its own.");
  for (size_t k = 0; k < panels_.size(); ++k) check_amount(amounts[k], count_vertices(panels_[k]));
  struct Work {
    std::shared_ptr<JointPress> press;
    std::vector<SmoothPanelResult> results;
  };
  const auto work = std::make_shared<Work>(Work{std::exchange(press_, nullptr), {}});
  run_abandonable(amounts.front().progress.get(), [work, amounts, panels = panels_] {
    if (!work->press) work->press = std::make_shared<JointPress>(panels, amounts);
    work->results = work->press->run(amounts);
  });
  press_ = work->press;
  return std::move(work->results);
}

}  // namespace reflines
