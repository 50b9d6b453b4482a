// One height-field piece as a Problem for the minimizer: its energy as a function of the unknowns.
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
#include "solver/piece_smoother.h"
#include "solver/quadrature.h"
#include "solver/target_terms.h"

namespace reflines {

class PieceProblem : public Problem {
 public:
  // Computes the stencils and the visibility of the lines at the start. A negative proximity is the default one: 10
  // with a free border, else 0, or 1e-6 for a cage. `quadrature_weight`: see ShapeOptions.
  PieceProblem(Piece piece, AffineMap map, StencilKind stencil, std::vector<ReflectionFunction> families,
               double proximity, LinearSolverKind solver, const Vector& quadrature_weight = {});

  void watch(Progress* progress) { smoother_.watch(progress); }  // may be null; told of what takes long beside a solve

  const HeightField& field() const { return piece_.field; }
  const std::vector<int>& vertices() const { return piece_.vertex; }         // the region's number of each vertex
  const std::vector<int>& triangles() const { return piece_.field.source; }  // the region's number of each triangle
  const Stencils& stencils() const { return stencils_; }
  const Vector& heights() const { return z_; }  // #V of the piece
  int hidden_count() const { return hidden_count_; }

  void set_heights(const Vector& x);
  void rest_at(const Vector& x);                        // sets the heights, and those the proximity pulls to
  void pull_to(const Vector& z, const Vector& weight);  // #V of the piece, see Energy; until reset
  void reset();  // as built, also in what later solves see: the same target then gives the same bits
  const Vector& unknowns() const { return x_; }
  bool moves_vertices() const { return map_.is_selection(); }  // each by itself, as no cage does

  Mask changeable() const;  // #T: at least one vertex is free

  // Rows of the targets follow the region's triangles.
  void set_targets(const std::vector<Target>& targets);
  double energy() { return energy_.evaluate(z_, nullptr); }
  Report minimize(const MinimizerOptions& options, Progress* progress);

  // Holds what `minimize` finds, from the next call on; rows follow the region's vertices. Throws InvalidInput for a
  // cage, whose vertices are no heights of the surface.
  void set_limit(const MoveLimit& limit);
  double move(int v) const;  // along the view, from the start; within the limit to the bit
  int limited(int v) const;  // -1 or 1: the vertex lies at its lowest or highest move, else 0

  // Of the current heights; valid until they change or another family is asked for.
  const ReflectionField& lines(int family);

  // Fills the piece's rows of vertex_theta and vertex_gradient: theta of the mean slopes around a vertex.
  void add_vertex_field(RegionField& region) const;
  ReflectionField lines_of(const Vector& z, int family) const;    // of any heights, #V of the piece
  bool depends_only_on(int triangle, const Vector& known) const;  // whether all its stencil's vertices have known > 0

  TargetTerms::Misfit misfit(const std::vector<Target>& targets) const;  // of the current heights
  PieceSmoother& smoother() { return smoother_; }

  const Vector& visible(int family) const { return visible_[family]; }  // #T: 0 to 1, how far its lines count

  const FieldAverage& average();  // of fields over its triangles

  int size() const override { return map_.size(); }
  double evaluate(const Vector& x, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override;
  const SparseMatrix* pattern() override;
  Vector rounding_weight(const SparseMatrix& hessian) override;
  PlanePositions places() override;
  std::unique_ptr<CoarseProblem> coarse(const Vector& x, const Vector& gradient) override;

 private:
  struct KeptField {
    int family = -1;  // none
    ReflectionField field;
  };
  Bounds bounds() const;
  void find_hidden();
  HessianAssembly& assembly();
  Vector2 slope_at(int t, int v, const TriangleDerivatives& u) const;

  Piece piece_;
  Stencils stencils_;
  Quadrature quadrature_;
  Stencils sampled_stencils_;                 // of the triangles that stand in the energy, where not all do
  std::vector<ReflectionFunction> families_;  // the last one, crossing the first, is for free borders only
  bool free_border_;
  bool pulled_ = false;  // to other heights than the start's, which hold a free border by themselves
  AffineMap map_;
  Energy energy_;
  std::vector<Vector> visible_;  // per family #T: weight by visibility at the start, and 0 where held_at_border
  TargetTerms terms_;
  std::unique_ptr<HessianAssembly> assembly_;  // made when first asked for
  std::unique_ptr<GalerkinProduct> product_;   // likewise; only where unknowns are not heights of vertices
  std::optional<Minimizer> minimizer_;         // always there; a new one after reset
  LinearSolverKind solver_;
  MoveLimit limit_;  // #V of the piece
  PieceSmoother smoother_;
  KeptField kept_field_;
  std::optional<FieldAverage> average_;  // made when first asked for
  Vector height_rounding_;               // of the moving vertices: the diagonal of their own Hessian
  int hidden_count_ = 0;                 // triangles with less than full weight
  Vector x_, z_;                         // current unknowns and heights
  Vector trial_z_, gradient_z_;          // work space
};

}  // namespace reflines
