// Checks of what the caller of a press gives.
#pragma once

#include "reflines/panel_smoother.h"
#include "reflines/smooth_panel.h"

namespace reflines {

// These throw InvalidInput with the first fault that they find, for a panel of so many vertices.

void check_press_options(const SmoothPanelOptions& options, Eigen::Index vertex_count);
void check_amount(const PressAmount& amount, Eigen::Index vertex_count);

}  // namespace reflines
