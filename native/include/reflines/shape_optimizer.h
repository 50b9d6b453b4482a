// The optimizer of a mesh region's heights for wanted reflection lines, seen from one view and lit by one or more
// families of parallel light lines. It is expensive to build and cheap to solve again.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reflines/border.h"
#include "reflines/crease_options.h"
#include "reflines/image_plane.h"
#include "reflines/linear_solver_kind.h"
#include "reflines/minimizer_options.h"
#include "reflines/move_limit.h"
#include "reflines/progress.h"
#include "reflines/region.h"
#include "reflines/region_field.h"
#include "reflines/report.h"
#include "reflines/smooth_target.h"
#include "reflines/stencil_kind.h"
#include "reflines/target.h"
#include "reflines/types.h"

namespace reflines {

class RegionPieces;

struct ShapeOptions {
  std::vector<Border> border;  // #V, or empty: clamped everywhere
  Mask held;                   // #V, or empty: vertices that stay whatever the border says
  StencilKind stencil = StencilKind::kConsistent;
  LinearSolverKind linear_solver = LinearSolverKind::kCholmod;
  CreaseOptions creases;  // which edges are held, and no stencil reaches across
  // The heights' affine map z = B x + c, where they follow fewer unknowns than there are vertices, as those of a
  // subdivided cage do: B is #V x n, `start` (n) are the unknowns at the start. Without them every free vertex is an
  // unknown.
  SparseMatrix B;
  Vector start;
  double proximity = -1.0;             // weight of staying near the start; negative: see PieceProblem
  std::shared_ptr<Progress> progress;  // or none: see ShapeOptimizer::watch; while it is built, too
  // #F, or empty for 1 everywhere: the factor of each triangle's term in the energy; those with 0 cost nothing.
  Vector quadrature_weight;
};

class ShapeOptimizer {
 public:
  // V (#V x 3), F (#F x 3) the region's triangles; `line_directions` one or more families, all seen from the same view.
  // The first one sets the frame. Throws InvalidInput; keeps no reference to its arguments.
  ShapeOptimizer(const Positions& V, const Triangles& F, const Vector3& view_direction,
                 const std::vector<Vector3>& line_directions, const ShapeOptions& options = {});
  ~ShapeOptimizer();

  // Tells `progress` (or none) between the steps of all that is made, and throws Cancelled there where it asks to stop.
  void watch(std::shared_ptr<Progress> progress);

  const Region& region() const { return region_; }
  const ImagePlane& frame() const;
  int triangle_count() const;
  int family_count() const { return family_count_; }

  // In the image plane, the same for all heights.
  PlanePositions xy() const;       // #V x 2
  PlanePositions centers() const;  // #F x 2, the triangles' centroids
  Vector area() const;             // #F, projected; 0 where not active

  // Current state. Rows of triangles outside the pieces are zero.
  Vector heights() const;                // #V, along the view
  Positions positions() const;           // #V x 3; vertices that did not move carry the bits they came with
  Mask free() const;                     // #V
  Mask active() const;                   // #F: triangles of height-field pieces
  Mask changeable() const;               // #F: those of them with a vertex that can move
  Vector theta(int family) const;        // #F, radians
  PlaneVectors field(int family) const;  // #F x 2, grad theta

  // All that the builders of targets in reflection/ need of the current state.
  // Valid until a solve or a reset, or until another family is asked for.
  const RegionField& region_field(int family);

  // Energy and |grad theta - target| (#F) of the current heights.
  double energy(const std::vector<Target>& targets);
  Vector residual(const Target& target) const;

  // Smooths the current field of a family, for build_smooth_target. Valid until the optimizer is destroyed; counts the
  // features that it leaves alone in region().
  FieldSmoother smoother(int family);

  // The lines that the surface would have with these heights along the view (#V); triangles that depend on a vertex of
  // weight 0 have weight 0. Read as a solve reads its own, so that heights that it can reach are met exactly.
  struct Lines {
    Target target;
    Vector theta;  // #F, radians
  };
  Lines lines_of(const Vector& heights, const Vector& weight, int family);

  // Wobble of the lines in degrees: the root mean square, over the triangles that can change and are no features, of
  // |field - field smoothed at `length`| times `length`: how far, within one length, the lines stray from their own
  // smooth course.
  double score(double length, int family);

  // Moves the heights towards the targets, every piece on its own: to the minimum of the energy; of targets that ask
  // for it, to what can be reached of them. On cancel or failure nothing has moved. Within a limit, and until the next
  // solve or reset, no vertex is beyond it by a bit; heights that were, of a solve before, are first put back to it.
  // Throws InvalidInput for a limit that does not fit, and for one of a cage.
  Report solve(const std::vector<Target>& targets, const MinimizerOptions& options = {}, Progress* progress = nullptr,
               const MoveLimit& limit = MoveLimit::none());

  // #V: -1 or 1 where the last solve's limit holds a vertex at its lowest or highest move, else 0.
  IndexVector at_limit() const;

  // The second-order model at the current heights that a solve would factor: lower triangle over the free vertices, the
  // pieces one after another.
  SparseMatrix hessian(const std::vector<Target>& targets, HessianModel model);

  void reset();  // the heights it was built with

 protected:
  // Where the heights follow fewer unknowns: the numbers of those that can move, and their values. Else empty.
  const std::vector<int>& free_unknowns() const { return free_unknowns_; }
  const Vector& unknowns() const;
  void rest_at(const Vector& unknowns);  // sets them, and what the proximity pulls to
  // Pulls vertices towards heights along the view with these weights (#V each) until a reset. Of one piece.
  void pull_to(const Vector& heights, const Vector& weight);

  Region region_;

 private:
  void enter(double fraction, const char* stage) const;
  void check(const Target& target) const;
  void check_family(int family) const;
  void count_features(double length, int family);
  void measure(const std::vector<Target>& targets, Report& report) const;
  void tell_limit(Report& report) const;

  std::unique_ptr<RegionPieces> pieces_;
  int family_count_;
  double feature_length_ = 0.0;  // see RegionField::feature
  std::shared_ptr<Progress> progress_;
  std::vector<int> free_unknowns_;
  bool sampled_ = false;  // few triangles count
  std::optional<RegionField> region_field_;
};

}  // namespace reflines
