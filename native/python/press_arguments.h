// Converts what presses of Smooth take from Python.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "python/array_arguments.h"
#include "reflines/panel_smoother.h"
#include "reflines/smooth_panel.h"

namespace reflines {

using LimitRange = std::optional<PlanePositions>;  // #V x 2, lowest and highest

// Refuses a given length that is not positive: in the C++ options 0 means automatic.
double given(const std::optional<double>& length, const char* name);

PressAmount amount_of(double strength, const std::optional<double>& limit, const LimitRange& limit_range,
                      std::shared_ptr<Progress> progress);

SmoothPanelOptions options_of(const std::string& lights, const std::optional<LightSet>& set,
                              const std::optional<LightSet>& judges, const std::optional<double>& length,
                              double flaw_size, bool symmetric);

}  // namespace reflines
