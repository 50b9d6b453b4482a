// The part of a subdivision surface that a CageOptimizer shapes: its triangles, and its matrix from the cage.
#pragma once

#include "reflines/cage_optimizer.h"
#include "reflines/types.h"

namespace reflines {

// A region of a subdivision surface, with its own indices of vertices and triangles. The unknowns' start is relative to
// the mean of the cage's vertices and not to the region's centroid, as the surface's heights are: the constant c of z =
// B x + c takes up the difference, and the other origin changes the last bits of every cage's result to no gain.
struct CageSurface {
  SparseMatrix S;       // #vertices x #V
  Positions positions;  // S V; of symmetric cages symmetric to the last bit
  // #vertices: kFlow at the region's border where lines are to run on, else kFree. `around` are the refined faces
  // beside it, and empty where there is no such vertex.
  std::vector<Border> border;
  Surroundings around;
  IndexVector refined;  // #vertices: number among all refined ones
  Triangles F;
  IndexVector parent;        // #F: the cage's face
  Vector quadrature_weight;  // #F or empty: see ShapeOptions
  SparseMatrix B;            // #V x #unknowns: the moves of the cage's vertices by each unknown
  Vector start;              // #unknowns: heights at the start, relative to the mean of the cage's vertices
};

// Subdivides the cage with positions V (#V x 3). Throws InvalidInput: what subdivide refuses, masks and partners of
// another length than the cage, partners that are not mutual, positions that are not finite.
CageSurface make_cage_surface(const Cage& cage, const Positions& V, const Vector3& view, const CageOptions& options);

}  // namespace reflines
