// Estimates what a height field would be without its flaws, and so how high they are.
#pragma once

#include "geometry/height_field.h"
#include "reflines/progress.h"
#include "reflines/types.h"

namespace reflines {

struct ReferenceSurface {
  PlaneVectors slopes;  // #T x 2, of the surface without flaws
  Vector flaws;         // #V: height of the field over it along the view
};

// Compares the field with two others: the one smoothed by place as in a press, which keeps what is design but is biased
// at borders and on irregular meshes, and polynomials around each place (see local_surface.h), which are exact there
// but know no design. A flaw is what both say. `length` is the size of flaws; `progress` may be null; throws Cancelled.
ReferenceSurface find_reference_surface(const HeightField& field, double length, Progress* progress);

}  // namespace reflines
