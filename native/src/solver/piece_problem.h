// One height-field piece as a Problem of the minimizer: its energy as a function of the unknowns.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "geometry/piece.h"
#include "optimization/affine_map.h"
#include "optimization/galerkin_product.h"
#include "optimization/minimizer.h"
#include "reflection/energy.h"
#include "reflection/field_average.h"
#include "reflection/hessian_assembly.h"
#include "reflection/reflection_field.h"
#include "reflines/move_limit.h"
#include "reflines/region_field.h"
#include "reflines/target.h"
#include "solver/families.h"
#include "solver/piece_smoother.h"
#include "solver/quadrature.h"
#include "solver/surface_kind.h"
#include "solver/target_terms.h"

namespace reflines {

class PieceProblem : public Problem {
 public:
  // Computes the stencils and the visibility of the lines at the start. The map of a mesh is a selection. A negative
  // proximity selects the default: 10 with a free border, else 0, or 1e-6 for a cage. `quadrature_weight`: see
  // ShapeOptions.
  PieceProblem(Piece piece, AffineMap map, SurfaceKind kind, StencilKind stencil, const Families& families,
               double proximity, LinearSolverKind solver, const Vector& quadrature_weight = {});

  void watch(Progress* progress) { smoother_.watch(progress); }  // null or the watcher of work other than solves

  const HeightField& field() const { return piece_.field; }
  const std::vector<int>& vertices() const { return piece_.vertex; }         // index in the region of each vertex
  const std::vector<int>& triangles() const { return piece_.field.source; }  // index in the region of each triangle
  const Stencils& stencils() const { return stencils_; }
  const Vector& heights() const { return z_; }    // #V of the piece
  const Mask& hidden() const { return hidden_; }  // #T: lines have less than full weight there
  const std::vector<ReflectionFunction>& families() const { return families_; }  // the last one crosses the first
  const std::vector<Vector>& trust() const { return visible_; }                  // #T for each family
  double pull_density() const { return energy_.pull_density(); }
  LinearSolverKind solver() const { return solver_; }

  void set_heights(const Vector& x);
  void rest_at(const Vector& x);                             // sets the heights, and the rest of the proximity term
  void stay_near(const Vector& z) { energy_.set_start(z); }  // #V of the piece: rest of the proximity until a reset
  void pull_to(const Vector& z, const Vector& weight);       // pull until reset, #V of the piece; see Energy
  void scale_move(double fraction);                          // of the unknowns from the start
  void set_move(const Vector& move);  // of a mesh's free vertices from the start: #V of the piece
  void reset();                       // restores the state as built, so that later solves give the same bits
  void forget_factor() { minimizer_->forget_factor(); }  // which depends on where a cancelled solve had come to
  const Vector& unknowns() const { return x_; }
  bool is_mesh() const { return kind_ == SurfaceKind::kMesh; }

  Mask changeable() const;  // #T: at least one vertex is free

  // Sets the targets, whose rows follow the region's triangles.
  void set_targets(const std::vector<Target>& targets);
  double energy();  // at the current heights
  Report minimize(const MinimizerOptions& options, Progress* progress);

  // Sets the limit of the moves from the next `minimize` on; rows follow the region's vertices. `rounding` is the error
  // of a move that is measured between positions.
  void set_limit(const MoveLimit& limit, double rounding);
  double move(int v) const;  // along the view, from the start; within the limit to the last bit
  int limited(int v) const;  // -1 or 1 where the vertex lies at its lowest or highest move, else 0

  // Returns the lines at the current heights; valid until these change.
  const ReflectionField& lines(int family);

  // Fills the piece's rows of vertex_theta and vertex_gradient: theta of the mean slopes around a vertex.
  void add_vertex_field(RegionField& region) const;
  ReflectionField evaluate_lines(const Vector& z, int family) const;  // at given heights, #V of the piece
  bool depends_only_on(int triangle,
                       const Vector& known) const;  // true where all vertices of its stencil have known > 0

  // Returns the misfit of the current heights. `set` tells that the energy has these targets now.
  TargetTerms::Misfit misfit(const std::vector<Target>& targets, bool set) const;
  PieceSmoother& smoother() { return smoother_; }
  const PieceSmoother& smoother() const { return smoother_; }

  const Vector& visible(int family) const { return visible_[family]; }  // #T: visibility weights in [0, 1]

  const FieldAverage& average();  // average of fields on its triangles

  int size() const override { return map_.size(); }
  double evaluate(const Vector& x, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override;
  const SparseMatrix* pattern() override;
  Vector rounding_weight(const SparseMatrix& hessian) override;
  PlanePositions places() override;
  std::unique_ptr<CoarseProblem> coarse(const Vector& x, const Vector& gradient) override;

 private:
  Vector find_unseen(const std::vector<Target>& targets) const;
  RowLimits limits() const;  // of a mesh's unknowns, or of a cage's surface
  double touching_distance(int v) const;
  void find_hidden(const std::vector<Vector>& sight);
  HessianAssembly& assembly();
  PlanePositions image_places();
  Vector2 slope_at(int t, int v, const TriangleDerivatives& u) const;

  Piece piece_;
  Stencils stencils_;
  Quadrature quadrature_;
  Stencils sampled_stencils_;                 // stencils of the triangles in the energy, where not all are
  std::vector<ReflectionFunction> families_;  // the last one crosses the first and is for free borders only
  bool free_border_;
  bool pulled_ = false;  // to other heights than the start's, which determine a free border
  AffineMap map_;
  SurfaceKind kind_;
  Energy energy_;
  // #T for each family: visibility at the start from the view or its own eye, and 0 where held_at_border.
  std::vector<Vector> visible_;
  bool has_eyes_;  // of families
  TargetTerms terms_;
  std::unique_ptr<HessianAssembly> assembly_;  // built on first use
  std::unique_ptr<GalerkinProduct> product_;   // likewise; only where unknowns are not heights of vertices
  std::optional<Minimizer> minimizer_;         // never empty; replaced by reset
  LinearSolverKind solver_;
  MoveLimit limit_;  // #V of the piece
  double limit_rounding_ = 0.0;
  double limit_size_ = 0.0;    // the largest finite end of a range
  double largest_move_ = 0.0;  // of a cage's surface
  PieceSmoother smoother_;
  std::vector<std::optional<ReflectionField>> lines_;  // of each family at the current heights, once asked for
  std::optional<FieldAverage> average_;                // built on first use
  Vector height_rounding_;                             // of the moving vertices: the diagonal of their own Hessian
  Mask hidden_;                                        // #T
  Vector x_, z_;                                       // current unknowns and heights
  Vector trial_z_, gradient_z_;                        // work space
  bool evaluated_ = false;                             // the energy was last evaluated at trial_z_
};

}  // namespace reflines
