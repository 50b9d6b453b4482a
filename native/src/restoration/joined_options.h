// The options of a press for a region that is joined with the faces beside it.
#pragma once

#include "reflines/panel_smoother.h"
#include "reflines/shape_optimizer.h"
#include "reflines/smooth_panel.h"
#include "restoration/joined_mesh.h"

namespace reflines {

// Says whether the faces beside a region take part in a press as what may have flaws, or tell how the region runs on.
enum class BesideRegion { kMoves, kStays };

// Returns the options of the region alone: nothing but the neighbours that are joined with it tells what lies beside.
ShapeOptions leave_surroundings(const ShapeOptions& shape);

ShapeOptions clamp_followed(ShapeOptions shape);  // of following

// Returns the options for the joined mesh: what the region holds stays, and the mesh ends clamped. `region_free` (#V)
// are the region's vertices that move.
ShapeOptions join_shape(const ShapeOptions& shape, const Mask& region_free, const JoinedMesh& joined,
                        Eigen::Index region_triangles, BesideRegion how);

// Returns the options for the joined mesh, with the length of flaws that the region has.
SmoothPanelOptions join_options(const SmoothPanelOptions& options, double length, const IndexVector& partner);

// Returns the amount for the joined mesh, with the limit that the region has, and none for the vertices beside it.
PressAmount join_amount(const PressAmount& amount, double limit, Eigen::Index beside);

// Returns the amount of a press, with the whole strength, that begins where vertices (of the joined mesh) have moved
// already, so that both moves together stay within the limit.
PressAmount begin_after(const PressAmount& amount, const Vector& move);

}  // namespace reflines
