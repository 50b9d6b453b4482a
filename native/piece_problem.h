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
  // A negative proximity is the default one: 10 with a free border, else 0, or 1e-6 for a cage. `share`: see
  // ShapeOptions.
  PieceProblem(Piece piece, Unknowns unknowns, StencilKind stencil, std::vector<ReflectionFunction> families,
               double proximity, LinearSolverKind solver, const Vector& share = {});

  void watch(Progress* progress) { progress_ = progress; }  // may be null; told of what takes long beside a solve

  const Piece& piece() const { return piece_; }
  const Stencils& stencils() const { return stencils_; }
  const Vector& heights() const { return z_; }  // #V of the piece
  int hidden_count() const { return hidden_count_; }

  void set_heights(const Vector& x);
  void rest_at(const Vector& x);                        // sets the heights, and those the proximity pulls to
  void pull_to(const Vector& z, const Vector& weight);  // #V of the piece, see Energy; until reset
  void reset();  // as built, also in what later solves see: the same target then gives the same bits
  const Vector& unknowns() const { return x_; }

  Mask changeable() const;  // #T: at least one vertex is free

  // Rows of the targets follow the region's triangles.
  void set_targets(const std::vector<Target>& targets);
  double energy() { return energy_.evaluate(z_, nullptr); }
  Report minimize(const MinimizerOptions& options, Progress* progress);

  // Of the current heights; valid until they change or another family is asked for.
  const ReflectionField& field(int family);

  // Fills the piece's rows of vertex_theta and vertex_gradient: theta of the mean slopes around a vertex.
  void add_vertex_field(RegionField& region) const;
  ReflectionField field_of(const Vector& z, int family) const;    // of any heights, #V of the piece
  bool depends_only_on(int triangle, const Vector& known) const;  // whether all its stencil's vertices have known > 0

  // What the current heights lack of the targets, over the triangles that count and can change: sum of area |grad theta
  // - wanted|^2 (of a value fit: of the difference of theta), and the sum of areas.
  struct Misfit {
    double squared = 0.0, area = 0.0;
  };
  Misfit misfit(const std::vector<Target>& targets);
  // The direction of directional smoothing is that of the isotropically smoothed lines: along lines that wobble by 40
  // degrees their own wobble is no detail.
  PlaneVectors smoothed(const PlaneVectors& gradient, const SmoothOptions& options, int family);

  const Vector& visible(int family) const { return visible_[family]; }  // #T: 0 to 1, how far its lines count

  // #T: what smoothing at `length` leaves alone in the field the piece started with; valid until asked for another.
  const Mask& features(double length, int family);

  int size() const override { return unknowns_.size(); }
  double evaluate(const Vector& x, Vector* gradient) override;
  const SparseMatrix& hessian(const Vector& x, HessianModel model) override;
  const SparseMatrix* pattern() override;
  Vector rounding_weight(const SparseMatrix& hessian) override;
  PlanePositions places() override;
  std::unique_ptr<CoarseProblem> coarse(const Vector& x, const Vector& gradient) override;

 private:
  // The last one used: a drag of the strength needs no new factor, and asks for the same field again and again.
  struct KeptSmoother {
    std::unique_ptr<FieldSmoother> smoother;
    double length = 0.0;
    PlaneVectors along;
    int family = 0;
    PlaneVectors rough, smooth;  // the last field and what became of it
    const PlaneVectors& of(const PlaneVectors& gradient);
  };
  struct KeptField {
    int family = -1;  // none
    ReflectionField field;
  };
  struct KeptFeatures {
    int family = -1;
    double length = 0.0;
    Mask mask;
  };

  void enter(double fraction, const char* stage) const;
  // Rows of the energy are the triangles that count.
  int counted() const { return energy_.stencils().triangle_count(); }
  int triangle(int row) const { return sampled_.empty() ? row : sampled_[row]; }
  double share(int row) const { return sampled_.empty() ? 1.0 : share_(row); }

  EnergyTerm term(const Target& target) const;
  EnergyTerm companion_term(const Target& target) const;  // of a value fit: the same wish as a gradient
  EnergyTerm crossing_term() const;
  double longest(int family) const;  // gradient that smoothing believes
  bool is_changeable(int t) const;
  void find_hidden();
  KeptSmoother& kept(KeptSmoother& kept, const SmoothOptions& options, const PlaneVectors& along, int family);
  HessianAssembly& assembly();
  Vector2 slope_at(int t, int v, const TriangleDerivatives& u) const;

  Piece piece_;
  Stencils stencils_;
  std::vector<int> sampled_;                  // the triangles that count; empty: all
  Vector share_;                              // of each of them
  Stencils sampled_stencils_;                 // theirs
  std::vector<ReflectionFunction> families_;  // the last one, crossing the first, is for free borders only
  bool free_border_;
  bool pulled_ = false;  // to other heights than the start's, which hold a free border by themselves
  Unknowns unknowns_;
  Energy energy_;
  std::unique_ptr<HessianAssembly> assembly_;  // made when first asked for
  std::unique_ptr<GalerkinProduct> product_;   // likewise; only where unknowns are not heights of vertices
  std::optional<Minimizer> minimizer_;         // always there; a new one after reset
  LinearSolverKind solver_;
  Progress* progress_ = nullptr;
  KeptSmoother isotropic_, directional_;
  KeptField kept_field_;
  KeptFeatures kept_features_;
  Vector height_rounding_;       // of the moving vertices: the diagonal of their own Hessian
  std::vector<Vector> visible_;  // per family #T: weight by visibility at the start, and 0 where held_at_border
  int hidden_count_ = 0;         // triangles with less than full weight
  Vector x_, z_;                 // current unknowns and heights
  Vector trial_z_, gradient_z_;  // work space
};

}  // namespace reflines
