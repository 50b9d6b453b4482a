// The press of a region with parts that no edge joins, but whose surfaces go on into each other.
#pragma once

#include <functional>
#include <memory>

#include "reflines/panel_smoother.h"
#include "reflines/smooth_panel.h"
#include "restoration/press.h"

namespace reflines {

using PreparePress = std::function<std::unique_ptr<Press>()>;

// Prepares presses of the region V (#V x 3), F (#F x 3) in which its parts that touch, or lie across a gap of
// `options.parts_gap` at most, are pressed as the panels of JointSmoother: their rims, where these are not held,
// move alike, and where vertices of two parts lie on each other they get the same move. Null where there are none: of
// one part, of more than 32, and where the border is faired or continues a curvature. Parts without an inner vertex
// face none. Where the panels cannot be solved the press of `prepare_whole` takes their place.
std::unique_ptr<Press> prepare_parted_region(const Positions& V, const Triangles& F, const Vector3& view,
                                             const Vector3& lines, const SmoothPanelOptions& options,
                                             const PressAmount& amount, const PreparePress& prepare_whole);

}  // namespace reflines
