// The press of Smooth for a cage alone.
#pragma once

#include <memory>

#include "reflines/joint_smoother.h"
#include "reflines/panel_smoother.h"
#include "restoration/press.h"

namespace reflines {

// Prepares presses of a cage, whose border is held. Throws what smooth_cage_panel throws.
std::unique_ptr<Press> prepare_cage(const JointCage& cage, const Vector3& view, const Vector3& lines,
                                    const SmoothPanelOptions& options, const PressAmount& amount);

}  // namespace reflines
