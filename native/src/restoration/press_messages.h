// The sentences in which a press of Smooth tells what it did, and what it left.
#pragma once

#include <string>
#include <vector>

#include "reflines/smooth_panel.h"

namespace reflines {

std::string explain_turned_faces();
std::string explain_worse_light(double before, double after);  // degrees of unevenness

// Returns the sentences for a result that was applied, the most important first.
std::vector<std::string> describe_result(const SmoothPanelReport& report);

}  // namespace reflines
