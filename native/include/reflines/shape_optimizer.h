// The optimizer of a mesh region's heights along a view for wanted reflection lines of one or more families of parallel
// light lines, each seen along the view or by an eye of its own. It is expensive to build and cheap to solve again.
#pragma once

#include <memory>
#include <vector>

#include "reflines/border.h"
#include "reflines/crease_options.h"
#include "reflines/eyes.h"
#include "reflines/image_plane.h"
#include "reflines/line_score.h"
#include "reflines/linear_solver_kind.h"
#include "reflines/minimizer_options.h"
#include "reflines/move_limit.h"
#include "reflines/progress.h"
#include "reflines/region.h"
#include "reflines/region_field.h"
#include "reflines/report.h"
#include "reflines/smooth_target.h"
#include "reflines/spd_factorize.h"
#include "reflines/stencil_kind.h"
#include "reflines/surroundings.h"
#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

struct ShapeOptions {
  std::vector<Border> border;  // #V, or empty: clamped everywhere
  Mask held;                   // #V, or empty: vertices that stay whatever the border says
  // #V or empty: each vertex's mirror image, itself on the plane, -1 where there is none; see mirror_pairs. Partners
  // keep equal moves along the view to the last bit: one unknown moves both. What holds or limits one of them holds for
  // both. That preserves the symmetry of a mesh where the view direction lies in the mirror plane.
  IndexVector partner;
  Surroundings around;  // or none; read for border vertices with Border::kCurvature or kFlow
  // One for each family, or none. Triangles that an eye does not see have no weight in its family; what no target's
  // family sees keeps its lines along the view, weakly.
  Eyes eyes;
  StencilKind stencil = StencilKind::kConsistent;
  LinearSolverKind linear_solver = LinearSolverKind::kCholmod;
  CreaseOptions creases;  // which edges are held, and no stencil reaches across
  // The linear part of the heights' affine map z = B x + c for the surface of a cage, whose unknowns are not its
  // vertices: B is #V x n, `start` (n) holds the unknowns at the start. Without them the surface is a mesh, and every
  // free vertex, or pair of partners, is an unknown.
  SparseMatrix B;
  Vector start;
  double proximity = -1.0;             // weight of the quadratic pull to the start; negative: see PieceProblem
  std::shared_ptr<Progress> progress;  // null or the watcher of building and later work, see ShapeOptimizer::watch
  // The face that each triangle was cut from (#F), by any numbers, or empty: each is its own. Reports count faces.
  IndexVector face_of_triangle;
  // The quadrature weights (#F, or empty for 1 everywhere): factors of each triangle's term in the energy. A triangle
  // of weight 0 is not evaluated.
  Vector quadrature_weight;
};

class ShapeOptimizer {
 public:
  // V (#V x 3) and F (#F x 3) are the region's vertices and triangles, `view_direction` the one along which it is a
  // height field; `line_directions` has one or more families of light lines, the first of which sets the frame. Throws
  // InvalidInput; keeps no reference to its arguments.
  ShapeOptimizer(const Positions& V, const Triangles& F, const Vector3& view_direction,
                 const std::vector<Vector3>& line_directions, const ShapeOptions& options = {});
  ~ShapeOptimizer();

  // Reports the stages of later work other than solves to `progress` (or to nobody); that work throws Cancelled where
  // it was cancelled.
  void watch(std::shared_ptr<Progress> progress);

  const Region& region() const;
  const ImagePlane& frame() const;
  int triangle_count() const;
  int family_count() const;
  int count_faces(const Mask& triangles) const;  // those that have a triangle in the mask (#F)
  const Positions& start() const;                // #V x 3, as handed in
  const Triangles& triangles() const;            // #F x 3, as handed in

  // These depend on the image plane only, not on the heights.
  PlanePositions xy() const;       // #V x 2
  PlanePositions centers() const;  // #F x 2, the triangles' centroids
  Vector area() const;             // #F, projected; 0 where not active

  // These depend on the current heights. Rows of triangles outside the pieces are zero.
  Vector heights() const;                // #V, along the view
  Positions positions() const;           // #V x 3; vertices that did not move carry the bits they came with
  Mask free() const;                     // #V
  Mask active() const;                   // #F: triangles of height-field pieces
  Mask changeable() const;               // #F: those of them with a vertex that can move
  Vector theta(int family) const;        // #F, radians
  PlaneVectors field(int family) const;  // #F x 2, grad theta

  // Returns how well the family's eye saw each triangle at the start (#F, 0 to 1): 1 along the view.
  Vector sight(int family) const;

  // Returns the input of the builders in targets/ at the current heights; valid until a solve, a reset, or a move that
  // is scaled.
  const RegionField& region_field(int family);

  // Returns that input with the values at the vertices alone, which is ten times faster; valid as long.
  const RegionField& vertex_field(int family);

  // Returns the factorization by this optimizer's linear solver, for LineHandles.
  SpdFactorize factorizer() const;

  // Return the energy, and |grad theta - target| (#F), at the current heights.
  double energy(const std::vector<Target>& targets);
  Vector residual(const Target& target) const;

  // Returns the smoother of a family's current field for build_smooth_target. Valid until the optimizer is destroyed;
  // using it updates the count of features in region().
  FieldSmoother smoother(int family);

  // The lines that the surface would have with other heights along the view (#V); triangles that depend on a vertex of
  // weight 0 have weight 0. The lines are evaluated as in a solve, so that reachable heights are reproduced exactly.
  struct Lines {
    Target target;
    Vector theta;  // #F, radians
  };
  Lines evaluate_lines(const Vector& heights, const Vector& weight, int family);

  // Scores the lines against their course without detail finer than `length`, over the triangles that can change.
  // Throws InvalidInput for a length that is not positive.
  LineScore score(double length, int family);

  // Moves the heights to a minimum of the targets' energy, every piece on its own; for targets with reachable_only, see
  // ReachableTarget. On cancellation or failure the heights are unchanged. With a limit no vertex is beyond it, to the
  // last bit, until the next solve or reset; heights beyond it from an earlier solve are first moved back to it. A
  // cage's limit is one of its surface: its own vertices move as far as that allows, and those that would move vertices
  // of limit 0 stay. Throws InvalidInput for a limit that does not fit.
  Report solve(const std::vector<Target>& targets, const MinimizerOptions& options = {}, Progress* progress = nullptr,
               const MoveLimit& limit = MoveLimit::none());

  // Returns for each vertex (#V) -1 or 1 where the last solve's limit holds it at its lowest or highest move, else 0.
  IndexVector at_limit() const;

  // Scales all moves from the heights that the optimizer was built with. Throws InvalidInput outside 0 to 1.
  void scale_move(double fraction);

  // Scales all moves by the fraction that the limit is of the largest one, where that is beyond it. Returns how many
  // vertices were beyond it, at least one then: the numbers are rounded.
  int keep_within(double limit);

  // Sets all free heights to those that the optimizer was built with plus `move` (#V), of partners the mean of both,
  // without a limit. Throws InvalidInput for numbers that are not finite, and for the surface of a cage.
  void set_move(const Vector& move);

  // Makes the proximity term pull towards these heights along the view (#V) instead of the start, until a reset. Throws
  // InvalidInput for numbers that are not finite.
  void stay_near(const Vector& heights);

  void reset();  // restores the heights that the optimizer was built with

  struct Internals;  // what the library's own sources use besides
  Internals& internals() { return *own_; }
  const Internals& internals() const { return *own_; }

 private:
  std::unique_ptr<Internals> own_;
};

}  // namespace reflines
