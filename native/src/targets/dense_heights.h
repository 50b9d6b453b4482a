// Samples the heights of another mesh under a region (a scan, an optimised panel) at the region's vertices.
#pragma once

#include "reflines/region_field.h"

namespace reflines {

struct DenseHeights {
  Vector height;  // #V of the region: height along the view, 0 where there is none
  Vector area;    // #V: area of the region around the vertex, 0 where there is no height
};

// Samples the heights of a dense panel. Both fields have one frame; `heights` (#vertices of the dense panel) are along
// its view. Between its vertices by the blend sum_i b_i (z_i + grad z_i (point - x_i) / 2), exact on quadratics: lines
// are second derivatives, and chords of the dense panel have none. Where its sheets overlap, one of them is taken.
DenseHeights sample_dense_heights(const RegionField& region, const RegionField& dense, const Vector& heights);

}  // namespace reflines
