// The optimizer of a region of a subdivision surface whose unknowns are heights of the cage: what the artist edits. The
// energy, the targets and the minimizer are those of the surface's triangles: z = S x + c, gradient S^T g, Hessian S^T
// H S.
#pragma once

#include <vector>

#include "native/cage_surface.h"
#include "native/shape_optimizer.h"
#include "native/types.h"

namespace reflines {

class CageOptimizer : public ShapeOptimizer {
 public:
  // V (#V x 3) of the cage. The region handed on to ShapeOptimizer is that of the subdivided surface.
  // Throws InvalidInput: what make_cage_surface and ShapeOptimizer refuse.
  CageOptimizer(const Cage& cage, const Positions& V, const Vector3& view_direction,
                const std::vector<Vector3>& line_directions, const CageOptions& options = {});

  Positions cage_positions() const;  // #V x 3; vertices that did not move carry the bits they came with
  Mask cage_free() const;            // #V

  const Triangles& triangles() const { return surface_.F; }        // #F x 3 of the region's vertices
  const IndexVector& parent() const { return surface_.parent; }    // #F: the cage's face
  const IndexVector& refined() const { return surface_.refined; }  // #region vertices: number among all refined ones

  // Moves the cage so that its surface is nearest to these heights along the view (#region vertices) by least squares;
  // `weight` (#region vertices) is the area each speaks for, 0 where there is no such height. Until a reset, solves are
  // drawn to the heights: of a shape longer than four faces of the cage they decide, of a shorter one the lines.
  // Vertices of the cage that no weighted height depends on stay; where that are all, nothing changes. Throws
  // InvalidInput: other lengths, a weight that is negative or not finite, a weighted height that is not finite.
  void fit(const Vector& heights, const Vector& weight);

 private:
  double height_density();  // of the pull to fitted heights, per area
  CageOptimizer(CageSurface surface, const Positions& V, const Vector3& view_direction,
                const std::vector<Vector3>& line_directions, const ShapeOptions& options);

  Positions V_;
  CageSurface surface_;
};

}  // namespace reflines
