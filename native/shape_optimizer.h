// The one object that bindings, tools and benchmarks use: a region of a mesh, a view, its families of light lines.
// Expensive to build, cheap to step.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "native/geometry/height_field.h"
#include "native/geometry/stencil.h"
#include "native/motion.h"
#include "native/optimization/minimizer.h"
#include "native/reflection/region_field.h"
#include "native/reflection/target.h"
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
};

// What became of the triangles and vertices that were handed in.
struct Region {
  int triangles = 0;  // in height-field pieces
  int free = 0, fixed = 0, clamped = 0;
  int pieces = 0;
  int silhouettes = 0;    // triangles left out, |n.v| < 0.02
  int turned_away = 0;    // triangles left out, n.v < 0
  int unused_pieces = 0;  // pieces without a free vertex
  int creases = 0;        // edges held because they bend by more than the crease angle
  int hidden = 0;         // triangles of less weight: their reflected ray is nearly parallel to the lines
  int features = 0;       // triangles the last smoothing left alone: strong bends that run on (see strong_features)
  bool closed = false;    // the region has no border edge
  std::vector<std::string> messages;  // sentences for the user
};

class ShapeOptimizer {
 public:
  // V (#V x 3), F (#F x 3) the region's triangles; `line_directions` one or more families, all seen from the same view.
  // The first one sets the frame. Throws InvalidInput; keeps no reference to its arguments.
  ShapeOptimizer(const Positions& V, const Triangles& F, const Vector3& view_direction,
                 const std::vector<Vector3>& line_directions, const ShapeOptions& options = {});
  ~ShapeOptimizer();

  const Region& region() const { return region_; }
  const ImagePlane& frame() const { return frame_; }
  int triangle_count() const { return triangle_count_; }
  int family_count() const { return family_count_; }

  // Current state. Rows of triangles outside the pieces are zero.
  Vector heights() const;                // #V, along the view
  Positions positions() const;           // #V x 3; vertices that did not move carry the bits they came with
  Mask free() const;                     // #V
  Mask active() const;                   // #F: triangles of height-field pieces
  Vector theta(int family) const;        // #F, radians
  PlaneVectors field(int family) const;  // #F x 2, grad theta

  // All that the builders of targets in reflection/ need of the current state.
  RegionField region_field(int family) const;

  // Energy and |grad theta - target| (#F) of the current heights.
  double energy(const std::vector<Target>& targets);
  Vector residual(const Target& target) const;

  // The current field of a family without its detail finer than options.length (see reflection/smooth.h), blended by
  // strength.
  Target smooth_target(const SmoothOptions& options, double strength, int family);

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

  Region region_;

 private:
  void check(const Target& target) const;
  void check_family(int family) const;
  void describe(const HeightField& field);
  void count_features(double length, int family);
  void measure(const std::vector<Target>& targets, Report& report) const;

  ImagePlane frame_;
  Positions V_;
  Triangles F_;
  int triangle_count_;
  int family_count_;
  std::vector<int> moving_;
  std::vector<std::unique_ptr<PieceProblem>> pieces_;
};

}  // namespace reflines
