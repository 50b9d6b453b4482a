#include "restoration/press_notes.h"

namespace reflines {

std::vector<Note> tell_result(const SmoothPanelReport& report) {
  std::vector<Note> result;
  if (report.limited > 0) {
    result.push_back({NoteKind::kLimited, report.limited});
  } else if (report.largest_control_move == 0) {
    result.push_back({NoteKind::kNoFlaws});
  }
  if (report.longer_waves) result.push_back({NoteKind::kLongerWaves});
  if (!report.solve.converged()) result.push_back({NoteKind::kUnfinished});
  if (report.held_faces > 0) result.push_back({NoteKind::kHeldFaces, report.held_faces});
  return result;
}

}  // namespace reflines
