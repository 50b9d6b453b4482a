// The start of a press without what is a flaw by itself: differences of a symmetric panel's halves, and bumps.
#pragma once

#include "reflines/progress.h"
#include "reflines/types.h"
#include "restoration/controlled_surface.h"

namespace reflines {

struct FlawlessShape {
  Vector heights;       // #V: the start without what looks like a flaw
  Vector sure_heights;  // #V: the start without what is surely one, near which a press stays
  IndexVector partner;  // #C: control vertices that are to move to one height, see MirrorEvidence; empty: no symmetry
  int bumps = 0;        // see SmoothPanelReport
  int mirrored = 0;
};

struct FlawSearch {
  bool halves = true;  // what one half of a symmetric panel has and the other has not
  bool bumps = true;   // round dents and bumps
};

// Looks for flaws of the surface with heights `start` (#V), bumps up to the size of `length`. `has_partners` tells that
// the surface's solves make mirror images move alike already. `progress` may be null; throws Cancelled.
FlawlessShape find_flawless_shape(ControlledSurface& surface, const Vector& start, double length, FlawSearch search,
                                  bool has_partners, Progress* progress);

// Returns the move (#C) with which free partners are as high as their mean. Stencils and the cut of quads are not
// symmetric, so that a solve leaves partners 3e-5 of the diagonal apart.
Vector average_partners(ControlledSurface& surface, const IndexVector& partner, const Vector& move);

}  // namespace reflines
