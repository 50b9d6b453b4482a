// The one object that bindings, tools and benchmarks use: a region of a mesh, a view, its families of light lines.
// Expensive to build, cheap to step.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "native/geometry/height_field.h"
#include "native/geometry/stencil.h"
#include "native/motion.h"
#include "native/optimization/minimizer.h"
#include "native/optimization/progress.h"
#include "native/reflection/region_field.h"
#include "native/reflection/target.h"
#include "native/region.h"
#include "native/types.h"

namespace reflines {

class PieceProblem;
struct SmoothOptions;

struct ShapeOptions {
  std::vector<Border> border;  // #V, or empty: clamped everywhere
  Mask held;                   // #V, or empty: vertices that stay whatever the border says
  StencilKind stencil = StencilKind::kConsistent;
  LinearSolverKind linear_solver = LinearSolverKind::kCholmod;
  double crease_angle = kCreaseAngle;  // radians: sharper edges are held and no stencil reaches across
  Motion motion;                       // or none: how vertices follow fewer unknowns, as those of a subdivided cage do
  double proximity = -1.0;             // weight of staying near the start; negative: see PieceProblem
  std::shared_ptr<Progress> progress;  // or none: see ShapeOptimizer::watch; while it is built, too
  Vector share;  // #F, or empty: all 1. How much each triangle's share of the energy counts; those with 0 cost nothing
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
  const ImagePlane& frame() const { return frame_; }
  int triangle_count() const { return triangle_count_; }
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

  // The current field of a family without its detail finer than options.length (see reflection/smooth.h), blended by
  // strength.
  Target smooth_target(const SmoothOptions& options, double strength, int family);

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

  // Moves the heights towards the targets, every piece on its own. On cancel or failure nothing has moved.
  Report solve(const std::vector<Target>& targets, const MinimizerOptions& options = {}, Progress* progress = nullptr);

  // The second-order model at the current heights that a solve would factor: lower triangle over the free vertices, the
  // pieces one after another.
  SparseMatrix hessian(const std::vector<Target>& targets, HessianModel model);

  void reset();  // the heights it was built with

 protected:
  // The numbers of the motion's unknowns that can move, and their heights; empty without a motion.
  const std::vector<int>& moving() const { return moving_; }
  const Vector& unknowns() const;
  void rest_at(const Vector& unknowns);  // sets them, and what the proximity pulls to
  // Pulls vertices towards heights along the view with these weights (#V each) until a reset. Of one piece.
  void pull_to(const Vector& heights, const Vector& weight);

  Region region_;

 private:
  void enter(double fraction, const char* stage) const;
  void check(const Target& target) const;
  void check_family(int family) const;
  RegionField make_region_field(int family);
  void count_features(double length, int family);
  void measure(const std::vector<Target>& targets, Report& report) const;

  ImagePlane frame_;
  Positions V_;
  Triangles F_;
  int triangle_count_;
  int family_count_;
  double feature_length_ = 0.0;  // see RegionField::feature
  std::shared_ptr<Progress> progress_;
  std::vector<int> moving_;
  bool sampled_ = false;  // few triangles count
  std::optional<RegionField> region_field_;
  std::vector<std::unique_ptr<PieceProblem>> pieces_;
};

}  // namespace reflines
