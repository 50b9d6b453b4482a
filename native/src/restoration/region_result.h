// The result for a region that was pressed together with what continues it.
#pragma once

#include "reflines/region.h"
#include "reflines/smooth_panel.h"
#include "restoration/control_range.h"
#include "restoration/tangent_match.h"

namespace reflines {

// Returns whether some place of the result is worse than the worst one before. Where a bent border meets one that is
// held, the turned tangents of the one and those of the other make a curl in the corner.
bool has_worse_place(const HealedFlaws& healed);

struct JoinedResult {
  const SmoothPanelResult& joined;
  const Positions& V;  // #V x 3 of the region at the start
  const ControlRange& range;
  const Region& region;
  double limit;
};

// Returns the result for the region alone after a move of its vertices (#V), of which `turned` turned the border.
SmoothPanelResult take_region(const JoinedResult& result, const TangentMatch& match, const Vector& move,
                              const Vector& turned);

}  // namespace reflines
