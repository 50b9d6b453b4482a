// The press of Smooth for a region whose border moves, too, to where the faces beside it tell that it should run.
#pragma once

#include <memory>
#include <vector>

#include "reflines/shape_optimizer.h"
#include "reflines/smooth_panel.h"
#include "restoration/press.h"

namespace reflines {

// Prepares presses of the region V (#V x 3), F (#F x 3) joined with the faces beside it, `shape.around`, of those that
// lie within two lengths of it, and keeps what that does to the region. Border vertices with options.fair_border (#V)
// move as inner ones do, where such faces surround them. The others stay but for those that `shape.border` sets free:
// neither slope nor curvature is held there, whichever it names, since the faces beside them take part in the press.
// Lines are judged over the region alone. The report says where the border was held for want of usable faces beside it;
// where that is all of it, or none is marked, the press is the ordinary one, with `shape.border` in force. Throws what
// smooth_panel throws, and SolverFailure where faces beside the region would turn by more than 45 degrees.
std::unique_ptr<Press> prepare_faired_border(const Positions& V, const Triangles& F, const Vector3& view,
                                             const std::vector<Vector3>& families, const ShapeOptions& shape,
                                             const SmoothPanelOptions& options);

}  // namespace reflines
