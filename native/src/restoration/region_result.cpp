#include "restoration/region_result.h"

#include <algorithm>

#include "restoration/press_notes.h"

namespace reflines {
namespace {

// The factor of the worst deviation of lines before, and the degrees of it, from which on a result has a worse place.
constexpr double kWorsePlace = 1.05, kLeastWorst = 0.3;

constexpr double kToldTurn = 0.3;  // degrees of the border's tangents that are worth a word

}  // namespace

bool has_worse_place(const HealedFlaws& healed) {
  return healed.worst_after > kWorsePlace * std::max(healed.worst_before, kLeastWorst);
}

SmoothPanelResult take_region(const JoinedResult& result, const TangentMatch& match, const Vector& move,
                              const Vector& turned) {
  SmoothPanelResult own{result.range.apply(result.V, match.frame.z(), move), result.joined.report};
  SmoothPanelReport& report = own.report;
  report.stray = result.joined.report.stray.head(match.triangles).eval();
  report.region = result.region;
  report.limit = result.limit;
  report.largest_move = report.largest_control_move = move.cwiseAbs().maxCoeff();
  if (!turned.isZero(0)) report.notes = tell_result(report);
  const double angle = find_turn(match, turned);
  if (angle >= kToldTurn) report.notes.push_back({.kind = NoteKind::kBorderTurned, .after = angle});
  return own;
}

}  // namespace reflines
