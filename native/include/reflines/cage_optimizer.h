// The optimizer of a region of a subdivision surface whose unknowns are heights of the cage: what the artist edits. The
// energy, the targets and the minimizer are those of the surface's triangles: z = S x + c, gradient S^T g, Hessian S^T
// H S.
#pragma once

#include <memory>
#include <vector>

#include "reflines/border.h"
#include "reflines/shape_optimizer.h"
#include "reflines/subdivision.h"
#include "reflines/types.h"

namespace reflines {

struct CageSurface;

struct CageOptions {
  Mask region;                     // #cage faces that may change; empty: all
  Border hold = Border::kClamped;  // of the region's border on the subdivided surface
  Mask held;                       // #V or empty: vertices that stay whatever the border says
  IndexVector partner;             // #V or empty: mirror_pairs, whose partners rise alike
  SubdivisionOptions subdivision;
  // From level 3 on: only every eighth triangle (Loop: fourth) counts, evenly spread and for the others, too. For
  // drags: updates take a fraction of the time, and shapes differ by 0.6 % of the move (those of level 2 by 7 %).
  bool sparse = false;
  ShapeOptions shape;  // its border, held, B, start and quadrature_weight are not read
};

class CageOptimizer : public ShapeOptimizer {
 public:
  // V (#V x 3) of the cage. The region handed on to ShapeOptimizer is that of the subdivided surface.
  // Throws InvalidInput: what make_cage_surface and ShapeOptimizer refuse.
  CageOptimizer(const Cage& cage, const Positions& V, const Vector3& view_direction,
                const std::vector<Vector3>& line_directions, const CageOptions& options = {});
  ~CageOptimizer();

  Positions cage_positions() const;  // #V x 3; vertices that did not move carry the bits they came with
  Mask cage_free() const;            // #V

  const Triangles& triangles() const;  // #F x 3 of the region's vertices
  const IndexVector& parent() const;   // #F: the cage's face
  const IndexVector& refined() const;  // #region vertices: number among all refined ones

  // Moves the cage so that its surface is nearest to these heights along the view (#region vertices) by least squares;
  // `weight` (#region vertices) is the area each speaks for, 0 where there is no such height. Until a reset, solves are
  // drawn to the heights: of a shape longer than four faces of the cage they decide, of a shorter one the lines.
  // Vertices of the cage that no weighted height depends on stay; where that are all, nothing changes. Throws
  // InvalidInput: other lengths, a weight that is negative or not finite, a weighted height that is not finite.
  void fit(const Vector& heights, const Vector& weight);

 private:
  double height_density();  // of the pull to fitted heights, per area
  CageOptimizer(std::unique_ptr<const CageSurface> surface, const Positions& V, const Vector3& view_direction,
                const std::vector<Vector3>& line_directions, const ShapeOptions& options);

  Positions V_;
  std::unique_ptr<const CageSurface> surface_;
};

}  // namespace reflines
