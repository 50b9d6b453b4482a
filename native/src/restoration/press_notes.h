// The notes of a press of Smooth on a result that was applied.
#pragma once

#include <vector>

#include "reflines/smooth_panel.h"

namespace reflines {

// Returns the notes that follow from the counts of the report, the most important first.
std::vector<Note> tell_result(const SmoothPanelReport& report);

}  // namespace reflines
