// Continues a region over the gap between its border and the surfaces beside it, for a border that follows them.
#pragma once

#include "reflines/surroundings.h"
#include "reflines/types.h"

namespace reflines {

// The widest gap relative to the diagonal of the region's bounding box, where none is given. Shut lines of cars are 3
// to 5 mm wide beside panels of 0.8 to 1.6 m.
inline constexpr double kAutomaticGap = 0.012;

struct GapOptions {
  double gap = 0.0;     // the widest that is crossed, in units of V; 0: kAutomaticGap times the diagonal
  double margin = 0.0;  // how far beyond the border the surfaces are followed, in units of V; 0: the widest gap
};

struct GapContinuation {
  Surroundings around;  // rings of triangles that begin at the region's border, or none
  Mask followed;        // #V: border vertices that are surrounded by triangles of the region and of `around`
  double gap = 0.0;     // the widest gap that was crossed
  Vector width;         // #V: of the gap at followed vertices, else 0
  Vector flush;         // #V: the step there, by which the other side is higher, else 0
};

// Continues the region V (#V x 3), F (#F x 3) along the surfaces `beside` (their triangles, in space, oriented alike)
// where its border is open. The border of the region counts as open where no triangle of `around`, see Surroundings,
// has it too and faces the same way within 60 degrees: an edge from which a hem turns away is the end of the skin.
//
// A surface is the neighbour of a border vertex where it faces the same way, begins within the gap, lies not over or
// under the region, is no more than 0.3 gaps higher or lower, and is tilted by no more than 10 degrees. Where there are
// several the nearest one counts. The rings follow it by local fits to its vertices, so that neither its mesh nor the
// width of the gap shows in them, and are moved by the step along its normal: they begin at the border without a step,
// with the tangents and the curvature that the neighbour has there. They end where it does.
GapContinuation continue_over_gap(const Positions& V, const Triangles& F, const Surroundings& around,
                                  const Positions& V_beside, const Triangles& F_beside, const GapOptions& options = {});

}  // namespace reflines
