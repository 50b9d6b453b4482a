#include "reflines/note.h"

#include <array>
#include <cstddef>

namespace reflines {
namespace {

constexpr std::array kNames = {
    "faces_would_turn",
    "light_would_worsen",
    "no_strength",
    "no_flaws",
    "limited",
    "longer_waves",
    "unfinished",
    "held_faces",
    "border_turned",
    "following_worsens",
    "joining_worsens",
    "continuing_worsens",
    "continuing_changes_nothing",
    "continuing_fails",
    "not_faired",
    "partly_faired",
    "turned_away",
    "sharp_edges",
    "sharp_edges_kept",
    "marked_edges",
    "marked_edges_kept",
    "edge_on",
    "unused_pieces",
    "hidden_faces",
    "unseen",
    "features",
    "curvature_unknown",
    "curvature_partly_unknown",
    "strong_border_bend",
    "flow_unknown",
};
static_assert(kNames.size() == static_cast<std::size_t>(NoteKind::kFlowUnknown) + 1);

}  // namespace

const char* to_string(NoteKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

}  // namespace reflines
