// The optimizer of a region of a subdivision surface whose unknowns are heights of the cage: what the artist edits. It
// owns a ShapeOptimizer of the surface's triangles, which has the energy, the targets and the minimizer: z = S x + c,
// gradient S^T g, Hessian S^T H S.
#pragma once

#include <memory>
#include <vector>

#include "reflines/border.h"
#include "reflines/shape_optimizer.h"
#include "reflines/subdivision.h"
#include "reflines/types.h"

namespace reflines {

struct CageSurface;

// Triangles that run on from one surface to another over a gap, in a cage that is made of several without a common
// vertex. They take the place of those at both rims, whose vertices then are no part of the region.
struct CageBridge {
  Triangles F;         // of the region's vertices
  IndexVector parent;  // the cage's face that each counts as one of
  Mask left_out;       // #triangles of the region without the bridge, or empty: none
};

struct CageOptions {
  Mask region;                 // #cage faces that may change; empty: all
  std::vector<Border> border;  // #V, or empty: clamped everywhere; of the region's border on the subdivided surface
  Mask held;                   // #V or empty: vertices that stay whatever the border says
  IndexVector partner;         // #V or empty: see mirror_pairs; partners keep equal moves along the view
  // The face whose mirror image each face is, or its own number (#cage faces), or empty: reports count both as one.
  IndexVector image_of;
  SubdivisionOptions subdivision;
  CageBridge bridge;
  // Samples the energy: from level 3 on only every eighth triangle (Loop: fourth), evenly spread, with a larger weight.
  // Meant for drags: updates take a fraction of the time, and shapes differ by 0.6 % of the move (those of level 2 by 7
  // %).
  bool sparse = false;
  ShapeOptions shape;  // its border, held, partner, B, start, face_of_triangle and quadrature_weight are not read
};

class CageOptimizer {
 public:
  // V (#V x 3) are the positions of the cage. Throws InvalidInput: what make_cage_surface and ShapeOptimizer refuse.
  CageOptimizer(const Cage& cage, const Positions& V, const Vector3& view_direction,
                const std::vector<Vector3>& line_directions, const CageOptions& options = {});
  ~CageOptimizer();

  // Returns the optimizer of the surface, for targets, solves and readings; its solves move the cage.
  ShapeOptimizer& surface() { return surface_optimizer_; }
  const ShapeOptimizer& surface() const { return surface_optimizer_; }

  // Returns the region of the surface, with the counts of the cage's free and fixed vertices.
  Region region() const;

  Positions cage_positions() const;  // #V x 3; vertices that did not move carry the bits they came with
  Mask cage_free() const;            // #V

  const Triangles& triangles() const;     // #F x 3 of the region's vertices
  const IndexVector& parent() const;      // #F: the cage's face
  const IndexVector& refined() const;     // #region vertices: number among all refined ones
  const SparseMatrix& influence() const;  // #region vertices x #V: the subdivision matrix; rows sum to 1, none is < 0

  // Moves the cage so that its surface is nearest to these heights along the view (#region vertices) by least squares;
  // `weight` (#region vertices) is the area of each height, 0 where there is none. Until a reset, solves are pulled to
  // the heights: they decide about shapes longer than four faces of the cage, the lines about shorter ones. Vertices of
  // the cage on which no weighted height depends stay; where that are all, nothing changes. Throws InvalidInput: other
  // lengths, a weight that is negative or not finite, a weighted height that is not finite.
  void fit(const Vector& heights, const Vector& weight);

 private:
  double height_density();  // weight of the pull to fitted heights, per area

  Positions V_;
  std::unique_ptr<const CageSurface> cage_surface_;
  ShapeOptimizer surface_optimizer_;
};

}  // namespace reflines
