// The part of a subdivision surface that a CageOptimizer shapes: its triangles, and how the cage lifts their vertices.
#pragma once

#include "reflines/cage_optimizer.h"
#include "reflines/types.h"

namespace reflines {

// Vertices and triangles have numbers of their own, those of the region.
struct CageSurface {
  SparseMatrix S;       // #vertices x #V
  Positions positions;  // S V; of symmetric cages symmetric to the last bit
  IndexVector refined;  // #vertices: number among all refined ones
  Triangles F;
  IndexVector parent;        // #F: the cage's face
  Vector quadrature_weight;  // #F or empty: see ShapeOptions
  SparseMatrix B;            // #V x #unknowns: which vertices of the cage each unknown lifts
  Vector start;              // #unknowns: their heights at the start, from the mean of the cage's vertices
};

// V (#V x 3) of the cage. Throws InvalidInput: what subdivide refuses, masks and partners of another length than the
// cage, partners that are not mutual, positions that are not finite.
CageSurface make_cage_surface(const Cage& cage, const Positions& V, const Vector3& view, const CageOptions& options);

}  // namespace reflines
