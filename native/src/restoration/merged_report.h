// The result for a region whose parts were pressed as panels of their own.
#pragma once

#include <vector>

#include "reflines/smooth_panel.h"

namespace reflines {

// A part of a region with what its press gave.
struct PressedPart {
  std::vector<int> triangles;  // of the region
  double area = 0;
  SmoothPanelReport report;
};

// Returns the report for all of the parts, which are the region's `triangle_count` triangles: counts are added, of
// lengths, moves and worst places the largest is taken, and measures are means over the area.
SmoothPanelReport merge_reports(const std::vector<PressedPart>& parts, Eigen::Index triangle_count);

}  // namespace reflines
