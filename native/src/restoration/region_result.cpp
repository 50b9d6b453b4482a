#include "restoration/region_result.h"

#include <algorithm>

#include "restoration/press_notes.h"
#include "restoration/press_rules.h"

namespace reflines {
bool has_worse_place(const HealedFlaws& healed) {
  return healed.worst_after > kRules.verdict.worse * std::max(healed.worst_before, kRules.visible);
}

SmoothPanelResult take_region(const JoinedResult& result, const TangentMatch& match, const Vector& move,
                              const Vector& turned) {
  SmoothPanelResult own{result.range.apply(result.V, match.frame.z(), move), result.joined.report};
  SmoothPanelReport& report = own.report;
  for (Vector* values : {&report.line_deviation, &report.verdict})  // empty in a result that was not judged
    *values = values->head(std::min<Eigen::Index>(values->size(), match.triangles)).eval();
  report.region = result.region;
  report.limit = result.limit;
  report.largest_move = report.largest_control_move = move.cwiseAbs().maxCoeff();
  if (!turned.isZero(0)) report.notes = tell_result(report);
  const double angle = find_turn(match, turned);
  if (angle >= kRules.visible) report.notes.push_back({.kind = NoteKind::kBorderTurned, .after = angle});
  return own;
}

}  // namespace reflines
