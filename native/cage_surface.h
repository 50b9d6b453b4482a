// The part of a subdivision surface that a CageOptimizer shapes: its triangles, and how the cage lifts their vertices.
#pragma once

#include "native/geometry/cage_border.h"
#include "native/geometry/subdivision.h"
#include "native/shape_optimizer.h"
#include "native/types.h"

namespace reflines {

struct CageOptions {
  Mask region;                                        // #cage faces that may change; empty: all
  BorderHold hold = BorderHold::kPositionAndTangent;  // of the region's border on the subdivided surface
  Mask held;                                          // #V or empty: vertices that stay whatever the border says
  IndexVector partner;                                // #V or empty: mirror_pairs, whose partners rise alike
  SubdivisionOptions subdivision;
  // From level 3 on: only every eighth triangle (Loop: fourth) counts, evenly spread and for the others, too. For
  // drags: updates take a fraction of the time, and shapes differ by 0.6 % of the move (those of level 2 by 7 %).
  bool sparse = false;
  ShapeOptions shape;  // its border, held, motion and share are not read
};

// With numbers of its own.
struct CageSurface {
  SparseMatrix S;       // #vertices x #V
  Positions positions;  // S V; of symmetric cages symmetric to the last bit
  IndexVector refined;  // #vertices: number among all refined ones
  Triangles F;
  IndexVector parent;  // #F: the cage's face
  Vector share;        // #F or empty: see ShapeOptions
  SparseMatrix rise;   // #V x #unknowns: which vertices of the cage each unknown lifts
  Vector start;        // #unknowns: their heights
};

// V (#V x 3) of the cage. Throws InvalidInput: what subdivide refuses, masks and partners of another length than the
// cage, partners that are not mutual, positions that are not finite.
CageSurface make_cage_surface(const Cage& cage, const Positions& V, const Vector3& view, const CageOptions& options);

}  // namespace reflines
