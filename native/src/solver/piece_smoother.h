// Smooths the lines of one height-field piece, and keeps the factored systems for the next call.
#pragma once

#include <memory>
#include <vector>

#include "geometry/stencil.h"
#include "reflection/line_smoother.h"
#include "reflection/reflection_field.h"
#include "reflines/linear_solver_kind.h"
#include "reflines/progress.h"

namespace reflines {

class PieceSmoother {
 public:
  // Takes what outlives the smoother, except `solver`. `trust` (#T, 0 to 1, for each family) is that of LineSmoother.
  // With `limit_outliers` gradients far beyond a strong bend are shortened, since a mesh, unlike the surface of a cage,
  // may have thin triangles.
  PieceSmoother(const HeightField& field, const Stencils& stencils, const std::vector<ReflectionFunction>& families,
                const std::vector<Vector>& trust, bool limit_outliers, LinearSolverKind solver);

  void watch(Progress* progress) { progress_ = progress; }  // may be null

  // Returns `gradient` (#T x 2) of a family without its detail finer than options.length. Directional smoothing is
  // along the isotropically smoothed lines: along lines that wave by 40 degrees their own waves are no detail. Throws
  // Cancelled.
  PlaneVectors smooth(const PlaneVectors& gradient, const SmoothOptions& options, int family);

  // Returns `gradient` (#T x 2) of a family without its detail finer than `length`: isotropic, linear, and through
  // features, which `smooth` keeps. Throws Cancelled.
  PlaneVectors smooth_all(const PlaneVectors& gradient, double length, int family);

  // Returns the strong_features (#T) at `length` of the field that the piece started with; valid until the family is
  // asked for at another length.
  const Mask& features(double length, int family);

  PlaneVectors start_gradient(int family) const;  // #T x 2, of the field that the piece started with

 private:
  // The last system of a family and the last field that it smoothed: while the strength is dragged, the same fields are
  // asked for again, those of the families in turn.
  struct Cache {
    std::shared_ptr<const LineSmoother> smoother;
    double length = 0.0, longest = 0.0;
    PlaneVectors along;
    PlaneVectors input, output;
    bool serves(const SmoothOptions& options, const PlaneVectors& wanted_along) const;
    const PlaneVectors& smooth(const PlaneVectors& gradient);
  };
  struct Features {
    double length = -1.0;  // none
    Mask mask;
  };

  std::shared_ptr<const LineSmoother> build(const SmoothOptions& options, const PlaneVectors& along, int family,
                                            const Mask& features);
  std::shared_ptr<const LineSmoother> find_same(double length, int family, const Mask& features) const;
  Cache& update(Cache& cache, const SmoothOptions& options, const PlaneVectors& along, int family);
  SpdSolve factorize(const SparseMatrix& matrix) const;
  double longest_gradient(int family) const;
  void enter(double fraction, const char* stage) const;

  const HeightField& field_;
  const Stencils& stencils_;
  const std::vector<ReflectionFunction>& families_;
  const std::vector<Vector>& trust_;
  bool limit_outliers_;
  LinearSolverKind solver_;
  Progress* progress_ = nullptr;
  std::unique_ptr<const SmootherElements> elements_;  // made for the first system
  std::vector<Cache> isotropic_, directional_;        // one for each family
  std::vector<Features> features_;                    // likewise
  std::vector<Cache> linear_;                         // likewise
};

}  // namespace reflines
