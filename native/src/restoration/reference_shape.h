// The start of a press without what is a flaw by itself: differences of a symmetric panel's halves.
#pragma once

#include <vector>

#include "geometry/height_field.h"
#include "reflines/types.h"
#include "restoration/controlled_surface.h"
#include "restoration/mirror_images.h"

namespace reflines {

struct ReferenceShape {
  Vector correction;  // #V: heights along the view to add to the start, which take away what looks like a flaw
  int mirrored = 0;   // see SmoothPanelReport
  // The control vertices at the start, and those (#C) that are to become mirror images across each plane of symmetry.
  SeenPoints control = {};
  std::vector<MirrorImages> partners = {};
};

// Takes out what one half of a symmetric panel has and the other has not, of a surface as a height field whose vertices
// move as its own do, at heights z along the view (#V). `has_partners` tells that the surface's solves make mirror
// images move alike already.
ReferenceShape even_halves(ControlledSurface& surface, const HeightField& field, const Vector& z, double length,
                           bool has_partners);

// Returns the move (#C) with which free partners are mirror images, each by half of the way. Stencils and the cut of
// quads are not symmetric, so that smoothing leaves partners apart.
Vector average_partners(ControlledSurface& surface, const ReferenceShape& reference, const Vector& move);

}  // namespace reflines
