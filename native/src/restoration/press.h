// The press of Smooth on one panel, prepared to be repeated with other amounts.
#pragma once

#include "reflines/panel_smoother.h"
#include "reflines/smooth_panel.h"

namespace reflines {

class Press {
 public:
  virtual ~Press() = default;

  // Throws InvalidInput, SolverFailure, Cancelled; is not used again after that.
  virtual SmoothPanelResult run(const PressAmount& amount) = 0;
};

}  // namespace reflines
