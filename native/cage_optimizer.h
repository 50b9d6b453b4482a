// The optimizer of a region of a subdivision surface whose unknowns are heights of the cage: what the artist edits. The
// energy, the targets and the minimizer are those of the surface's triangles: z = S x + c, gradient S^T g, Hessian S^T
// H S.
#pragma once

#include <vector>

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
  ShapeOptions shape;  // its border, held and motion are not read
};

class CageOptimizer : public ShapeOptimizer {
 public:
  // V (#V x 3) of the cage. The region handed on to ShapeOptimizer is that of the subdivided surface, see `surface`.
  // Throws InvalidInput: what subdivide and ShapeOptimizer refuse, masks and partners of another length than the cage.
  CageOptimizer(const Cage& cage, const Positions& V, const Vector3& view_direction,
                const std::vector<Vector3>& line_directions, const CageOptions& options = {});

  Positions cage_positions() const;  // #V x 3; vertices that did not move carry the bits they came with
  Mask cage_free() const;            // #V

  const Triangles& triangles() const { return surface_.F; }        // #F x 3 of the region's vertices
  const IndexVector& parent() const { return surface_.parent; }    // #F: the cage's face
  const IndexVector& refined() const { return surface_.refined; }  // #region vertices: number among all refined ones

  // Moves the cage so that its surface is nearest to these heights along the view (#region vertices) by least squares;
  // `weight` (#region vertices, >= 0) is 0 where there is no such height. That shape is then the one a free border is
  // drawn to. Vertices of the cage that no weighted height depends on stay.
  void fit(const Vector& heights, const Vector& weight);

 private:
  // The region of the subdivided surface, with its own numbers.
  struct Surface {
    SparseMatrix S;       // #region vertices x #V
    IndexVector refined;  // #region vertices
    Triangles F;
    IndexVector parent;
    SparseMatrix rise;  // #V x #unknowns: which vertices of the cage each unknown lifts
    Vector start;       // #unknowns: their heights
  };
  static Surface make_surface(const Cage& cage, const Positions& V, const Vector3& view, const CageOptions& options);
  CageOptimizer(Surface surface, const Positions& V, const Vector3& view_direction,
                const std::vector<Vector3>& line_directions, const ShapeOptions& options);

  Positions V_;
  Surface surface_;
};

}  // namespace reflines
