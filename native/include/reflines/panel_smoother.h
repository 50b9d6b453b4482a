// Presses of Smooth on one panel, of which the second costs a tenth of the first: the flaws are found once.
#pragma once

#include <functional>
#include <memory>

#include "reflines/cage_optimizer.h"
#include "reflines/move_limit.h"
#include "reflines/progress.h"
#include "reflines/smooth_panel.h"
#include "reflines/types.h"

namespace reflines {

class Press;

// Tells how much of a panel's move a press makes; see SmoothPanelOptions, which has these too.
struct PressAmount {
  double strength = 1.0;
  double limit = 0.0;
  MoveLimit limit_range;
  std::shared_ptr<Progress> progress;  // of this press, or none
  // False: the report has no measures of the result, and a light that became worse refuses nothing. The positions are
  // those of a judged press that is applied. With another strength, as a drag shows it, that is a tenth of the work.
  bool judged = true;
};

PressAmount amount_of(const SmoothPanelOptions& options);

// Keeps what presses of a panel have in common: its flaws, the shape without them, the solve for that shape without a
// limit, and the matrices of both. Another strength costs the measures of the result, another limit a solve besides.
// Each press gives the bits that smooth_panel gives for the same options, whatever was pressed before.
class PanelSmoother {
 public:
  // Take the arguments of smooth_panel and smooth_cage_panel; strength, limit, its fractions and progress of the
  // options are not read. Throw InvalidInput; the work is done in the first press. Keep no reference to their
  // arguments.
  PanelSmoother(const Positions& V, const Triangles& F, const Vector3& view_direction, const Vector3& line_direction,
                const SmoothPanelOptions& options = {});
  PanelSmoother(const Cage& cage, const Positions& V, const Vector3& view_direction, const Vector3& line_direction,
                const CageOptions& cage_options, const SmoothPanelOptions& options = {});

  // Presses the panel as it was given. Throws InvalidInput, SolverFailure, Cancelled: then the next press finds the
  // flaws again.
  SmoothPanelResult press(const PressAmount& amount);

 private:
  Eigen::Index control_count_;
  std::function<std::unique_ptr<Press>(const PressAmount&)> prepare_;
  std::shared_ptr<Press> press_;  // null before the first press, and after one that was cancelled
};

}  // namespace reflines
