// One height-field piece as a Problem: geometry and reflection on one side, the minimizer on the other.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "native/geometry/pieces.h"
#include "native/optimization/galerkin.h"
#include "native/optimization/minimizer.h"
#include "native/optimization/unknowns.h"
#include "native/reflection/energy.h"
#include "native/reflection/field.h"
#include "native/reflection/hessian_assembly.h"
#include "native/reflection/region_field.h"
#include "native/reflection/smooth.h"
#include "native/reflection/target.h"

namespace reflines {

class PieceProblem : public Problem {
 public:
  // A negative proximity is the default one: 10 with a free border, else 0, or 1e-6 for a cage.
  PieceProblem(Piece piece, Unknowns unknowns, StencilKind stencil, std::vector<ReflectionFunction> families,
               double proximity, LinearSolverKind solver);

  const Piece& piece() const { return piece_; }
  const Stencils& stencils() const { return stencils_; }
  const Vector& heights() const { return z_; }  // #V of the piece
  int hidden_count() const { return hidden_count_; }

  void set_heights(const Vector& x);
  void rest_at(const Vector& x);  // sets the heights, and those the proximity pulls to
  void reset();                   // as built, also in what later solves see: the same target then gives the same bits
  const Vector& unknowns() const { return x_; }

  Vector changeable_area() const;  // #T: a triangle's projected area, 0 where none of its vertices is free

  // Rows of the targets follow the region's triangles.
  void set_targets(const std::vector<Target>& targets);
  double energy() { return energy_.evaluate(z_, nullptr); }
  Report minimize(const MinimizerOptions& options, Progress* progress);

  ReflectionField field(int family) const;

  // Fills the piece's rows of area, vertex_theta and vertex_gradient: theta of the mean slopes around a vertex.
  void add_vertex_field(RegionField& region) const;
  // The direction of directional smoothing is that of the isotropically smoothed lines: along lines that wobble by 40
  // degrees their own wobble is no detail.
  PlaneVectors smoothed(const PlaneVectors& gradient, const SmoothOptions& options, int family);

  // #T: what smoothing at `length` leaves alone in the field the piece started with.
  Mask features(double length, int family) const;

  int size() const override { return unknowns_.size(); }
  double evaluate(const Vector& x, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override;
  const SparseMatrix* smooth_modes() override;

 private:
  // The last one used: a drag of the strength needs no new factor.
  struct KeptSmoother {
    std::unique_ptr<FieldSmoother> smoother;
    double length = 0.0;
    PlaneVectors along;
    int family = 0;
  };

  EnergyTerm term(const Target& target) const;
  ReflectionField start_field(int family) const;
  EnergyTerm crossing_term() const;
  void find_hidden();
  const FieldSmoother& kept(KeptSmoother& kept, const SmoothOptions& options, const PlaneVectors& along, int family);
  Vector2 slope_at(int t, int v, const TriangleDerivatives& u) const;

  Piece piece_;
  Stencils stencils_;
  std::vector<ReflectionFunction> families_;  // the last one, crossing the first, is for free borders only
  bool free_border_;
  Unknowns unknowns_;
  Energy energy_;
  std::unique_ptr<HessianAssembly> assembly_;   // made when first asked for
  std::unique_ptr<GalerkinProduct> product_;    // likewise; only where unknowns are not heights of vertices
  std::unique_ptr<SparseMatrix> smooth_modes_;  // likewise
  std::optional<Minimizer> minimizer_;          // always there; a new one after reset
  LinearSolverKind solver_;
  KeptSmoother isotropic_, directional_;
  std::vector<Vector> visible_;  // per family #T: weight by visibility at the start
  int hidden_count_ = 0;         // triangles with less than full weight
  Vector x_, z_;                 // current unknowns and heights
  Vector trial_z_, gradient_z_;  // work space
};

}  // namespace reflines
