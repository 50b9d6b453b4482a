// The preparation that the presses of one panel and of several have in common.
#pragma once

#include <vector>

#include "reflines/panel_smoother.h"
#include "reflines/shape_optimizer.h"
#include "reflines/smooth_panel.h"
#include "restoration/used_vertices.h"

namespace reflines {

// Returns the light lines and, where both count, those that cross them; those of the set of lights where there is one.
std::vector<Vector3> make_families(const Vector3& view, const Vector3& lines, const SmoothPanelOptions& options);

// Sets the options of all presses. Noise makes creases, and held ones would keep it; smoother and weights keep
// what bends. The frame follows the light lines given also where a set takes their place: which flaws are found does
// not depend on the lights of a set.
void set_restoration_rules(const SmoothPanelOptions& options, const Vector3& lines, const PressAmount& amount,
                           double proximity, ShapeOptions& shape);

// Returns what holds of the used vertices, of `vertex_count` that there are.
ShapeOptions choose_shape(const UsedVertices& used, const SmoothPanelOptions& options, Eigen::Index vertex_count);

}  // namespace reflines
