// The start of a press without what is a flaw by itself: differences of a symmetric panel's halves.
#pragma once

#include <vector>

#include "reflines/types.h"
#include "restoration/controlled_surface.h"
#include "restoration/mirror_evidence.h"

namespace reflines {

struct FlawlessShape {
  Vector heights;  // #V: the start without what looks like a flaw
  // Across each plane of symmetry the control vertices (#C) that are to move to one height; see MirrorPartners.
  std::vector<MirrorPartners> partners = {};
  int mirrored = 0;  // see SmoothPanelReport
};

// Takes out what one half of a symmetric panel has and the other has not, of the surface with heights `start` (#V).
// `has_partners` tells that the surface's solves make mirror images move alike already.
FlawlessShape even_halves(ControlledSurface& surface, const Vector& start, double length, bool has_partners);

// Returns the move (#C) with which free partners are as high as their mean. Stencils and the cut of quads are not
// symmetric, so that smoothing leaves partners apart.
Vector average_partners(ControlledSurface& surface, const std::vector<MirrorPartners>& partners, const Vector& move);

}  // namespace reflines
