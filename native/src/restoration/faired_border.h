// The press of Smooth for a region whose border moves, too, to where the faces beside it tell that it should run.
#pragma once

#include <vector>

#include "reflines/shape_optimizer.h"
#include "reflines/smooth_panel.h"

namespace reflines {

// Presses the region V (#V x 3), F (#F x 3) joined with the faces beside it, `shape.around`, of those that lie within
// two lengths of it, and keeps what that does to the region. Border vertices with options.fair_border (#V) move as
// inner ones do; the others are held as `shape.border` says. Lines are judged over the region alone. Without faces
// beside it the whole border is held, and the report says so. Throws what smooth_panel throws, and SolverFailure where
// faces beside the region would turn by more than 45 degrees.
SmoothPanelResult press_faired_border(const Positions& V, const Triangles& F, const Vector3& view,
                                      const std::vector<Vector3>& families, const ShapeOptions& shape,
                                      const SmoothPanelOptions& options);

}  // namespace reflines
