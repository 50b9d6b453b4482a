// The optimizer of a mesh region's heights along a view for wanted reflection lines of one or more families of parallel
// light lines, each seen along the view or by an eye of its own. It is expensive to build and cheap to solve again.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
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

struct Boundary;
struct Families;
struct HeightField;
class RegionPieces;
enum class SurfaceKind;

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

  const Region& region() const { return region_; }
  const RegionPieces& pieces() const { return *pieces_; }
  const ImagePlane& frame() const;
  int triangle_count() const;
  int family_count() const { return family_count_; }
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
  LineScore score(double length, int family) { return score_field(field(family), length, family); }
  LineScore score_field(const PlaneVectors& field, double length, int family);  // of other lines, #F x 2

  // Moves the heights to a minimum of the targets' energy, every piece on its own; for targets with reachable_only, see
  // ReachableTarget. On cancellation or failure the heights are unchanged. With a limit no vertex is beyond it, to the
  // last bit, until the next solve or reset; heights beyond it from an earlier solve are first moved back to it. A
  // cage's limit is one of its surface: its own vertices move as far as that allows, and those that would move vertices
  // of limit 0 stay. Throws InvalidInput for a limit that does not fit.
  Report solve(const std::vector<Target>& targets, const MinimizerOptions& options = {}, Progress* progress = nullptr,
               const MoveLimit& limit = MoveLimit::none());

  bool continues_curvature() const { return !border_.empty(); }  // that of ShapeOptions::around, somewhere

  // Returns for each vertex (#V) -1 or 1 where the last solve's limit holds it at its lowest or highest move, else 0.
  IndexVector at_limit() const;

  // Returns the second-order model that a solve would factor at the current heights: the lower triangle over the
  // unknowns, the pieces one after another.
  SparseMatrix hessian(const std::vector<Target>& targets, HessianModel model);

  // Scales all moves from the heights that the optimizer was built with. Throws InvalidInput outside 0 to 1.
  void scale_move(double share);

  // Scales all moves by the share that the limit is of the largest one, where that is beyond it. Returns how many
  // vertices were beyond it, at least one then: the numbers are rounded.
  int keep_within(double limit);

  // Keep the heights, with the limit of the solve that found them, and return to them.
  struct State {
    std::vector<Vector> unknowns;  // of each piece
    MoveLimit limit;
  };
  State state() const;
  void restore(const State& state);

  // Sets all free heights to those that the optimizer was built with plus `move` (#V), of partners the mean of both,
  // without a limit. Throws InvalidInput for numbers that are not finite, and for the surface of a cage.
  void set_move(const Vector& move);

  // Makes the proximity term pull towards these heights along the view (#V) instead of the start, until a reset. Throws
  // InvalidInput for numbers that are not finite.
  void stay_near(const Vector& heights);

  void reset();  // restores the heights that the optimizer was built with

  // These are for the surface of a cage (see ShapeOptions::B), which is one piece: the indices of the unknowns that can
  // move, and their values. free_unknowns is empty without B.
  const std::vector<int>& free_unknowns() const { return free_unknowns_; }
  const Vector& unknowns() const;
  void rest_at(const Vector& unknowns);  // sets them, and the rest position of the proximity term
  // Adds a quadratic pull of the vertices towards heights along the view with these weights (#V each) until a reset.
  void pull_to(const Vector& heights, const Vector& weight);

 private:
  void enter(double fraction, const char* stage) const;
  void forget_lines();
  void continue_border(const HeightField& field, const Boundary& boundary, const Surroundings& around,
                       const Families& families);
  std::vector<Target> with_border(const std::vector<Target>& targets) const;
  void check(const Target& target) const;
  void check_family(int family) const;
  void count_features(double length, int family);
  void measure(const std::vector<Target>& targets, Report& report) const;
  void tell_limit(Report& report) const;

  Region region_;
  Eigen::AlignedBox3d box_;  // around the region's faces
  std::unique_ptr<RegionPieces> pieces_;
  IndexVector partner_;  // see ShapeOptions
  SurfaceKind kind_;
  int family_count_;
  LinearSolverKind linear_solver_;
  double feature_length_ = 0.0;  // see RegionField::feature
  std::shared_ptr<Progress> progress_;
  std::vector<int> free_unknowns_;
  std::vector<Vector> sight_;   // #F of each family, or none; see Families
  std::vector<Target> border_;  // continue the surroundings' curvature; see continue_curvature
  IndexVector face_of_triangle_;
  bool sampled_ = false;                                      // some triangles have the quadrature weight 0
  std::map<int, RegionField> region_fields_, vertex_fields_;  // of the families asked for, at the current heights
};

}  // namespace reflines
