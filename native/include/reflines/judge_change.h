// Judges what a tool changed on a panel by a set of lights that it was not solved for.
#pragma once

#include <memory>

#include "reflines/light_set.h"
#include "reflines/progress.h"
#include "reflines/shape_optimizer.h"
#include "reflines/smooth_panel.h"
#include "reflines/types.h"

namespace reflines {

// Degrees by which lines of a judged change get worse before it is reported. The shapes without flaws are estimated,
// before and after: all 39 places that were reported after solves of real panels had become worse indeed. A press
// knows the course of its lines and judges itself, see SmoothPanelOptions::judges.
inline constexpr double kJudgedWorse = 0.5;

// Returns the place where lines of the panel F (#F x 3) got worse by most in one of the lights between the positions
// `before` and `after` (#V x 3), which differ along `view_direction`: by kJudgedWorse or more. The deviation of lines
// is that of inspect_panel, from the course without flaws of each shape; `length` is the size of flaws, above 0. Throws
// InvalidInput, SolverFailure, Cancelled; `progress` may be null.
WorsePlace judge_change(const Positions& before, const Positions& after, const Triangles& F,
                        const Vector3& view_direction, const LightSet& lights, double length,
                        const std::shared_ptr<Progress>& progress);

// Judges likewise what an optimizer's last solve changed.
WorsePlace judge_change(const ShapeOptimizer& optimizer, const LightSet& lights, double length,
                        const std::shared_ptr<Progress>& progress);

}  // namespace reflines
