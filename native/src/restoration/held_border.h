// The press of Smooth for a region whose border is held.
#pragma once

#include <memory>
#include <vector>

#include "reflines/joint_smoother.h"
#include "reflines/panel_smoother.h"
#include "reflines/shape_optimizer.h"
#include "reflines/smooth_panel.h"
#include "restoration/press.h"

namespace reflines {

// Prepares presses of the region V (#V x 3), F (#F x 3) with `shape.border`. Where that continues the curvature of
// `shape.around`, the region is pressed with a clamped border, too, and that result is kept, and said, unless the first
// is applied and in no light less even than it. Throws what smooth_panel throws.
std::unique_ptr<Press> prepare_held_border(const Positions& V, const Triangles& F, const Vector3& view,
                                           const std::vector<Vector3>& families, const ShapeOptions& shape,
                                           const SmoothPanelOptions& options);

// Prepares presses of the region of a cage's surface with the cage's border likewise. Throws what smooth_cage_panel
// throws.
std::unique_ptr<Press> prepare_cage(const JointCage& cage, const Vector3& view, const Vector3& lines,
                                    const SmoothPanelOptions& options, const PressAmount& amount);

}  // namespace reflines
