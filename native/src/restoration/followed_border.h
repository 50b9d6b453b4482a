// The press of Smooth for a region whose border stays in place and takes its tangents from the faces beside it.
#pragma once

#include <memory>
#include <vector>

#include "reflines/shape_optimizer.h"
#include "reflines/smooth_panel.h"
#include "restoration/press.h"

namespace reflines {

// Returns whether the border has vertices with Border::kFollow.
bool follows(const std::vector<Border>& border);

// Prepares presses of the region V (#V x 3), F (#F x 3), whose border follows somewhere, joined with the triangles of
// `shape.around`, which stay. The border's tangents are turned to those beside it first (see match_tangents), then
// flaws are looked for, and last what their removal turned is turned back. Lines are judged over both, against those
// with turned tangents; the limit, which holds for the whole move, and the length are those of the region alone. Where
// nothing is joined with the region, or a light would become worse, the border is clamped instead; of the latter the
// report tells. Throws what smooth_panel throws.
//
// It is nobody's default: four real panels, clean and cut into halves that each follow the other, are bent by 0.24
// degrees at most (median), with a clamped border by 0.18.
std::unique_ptr<Press> prepare_followed_border(const Positions& V, const Triangles& F, const Vector3& view,
                                               const std::vector<Vector3>& families, const ShapeOptions& shape,
                                               const SmoothPanelOptions& options);

}  // namespace reflines
