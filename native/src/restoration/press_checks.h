// Checks of what the caller of a press gives.
#pragma once

#include "reflines/panel_smoother.h"
#include "reflines/smooth_panel.h"

namespace reflines {

// Throw InvalidInput with the first fault of the options or the amount for a panel of so many vertices.
void check_press_options(const SmoothPanelOptions& options, Eigen::Index vertex_count);
void check_amount(const PressAmount& amount, Eigen::Index vertex_count);

}  // namespace reflines
