// Smooths a field of gradients over a surface by one implicit step (paper, section 4, "Smoothing").
//
// G (a vector at every vertex) minimises sum_T A_T (c_T |mean of G over T - g_T|^2 + l^4 |Hessian of G|^2), where l =
// length / 2 pi and c_T is the trust weight of T. A wave of wavelength w keeps 1 / (1 + (length / w)^4) of its
// amplitude: half at w = length, 6 % at half of it, 94 % at twice. Linear fields have no Hessian energy, also at the
// border, so a field that is already fair is not bent there (diffusion bends it; the squared Laplacian leaves every
// harmonic border wave).
#pragma once

#include <limits>

#include "geometry/stencil.h"
#include "reflines/progress.h"
#include "reflines/smooth_target.h"
#include "reflines/spd_factorize.h"
#include "reflines/types.h"

namespace reflines {

class LineSmoother {
 public:
  // Assembles and factors the system. `along` (#T x 2) are gradients whose level lines are the direction; read only for
  // directional smoothing. `trust` (#T, 0 to 1) weights each triangle's gradient; `features` (#T, see strong_features)
  // keep their gradients and hardly count around them. Throws Cancelled; `progress` may be null.
  LineSmoother(const HeightField& field, const Stencils& stencils, const SmoothOptions& options,
               const PlaneVectors& along, const Vector& trust, Mask features, const SpdFactorize& factorize,
               const Progress* progress = nullptr);

  // Returns the smoothed field (#T x 2) of `gradient` (#T x 2). `longest` is the largest trusted |grad theta| in
  // radians / length: longer gradients, and longer changes by smoothing, are shortened to it, since they are artefacts
  // of thin triangles.
  PlaneVectors smooth(const PlaneVectors& gradient, double longest = std::numeric_limits<double>::infinity()) const;

  // Returns true where an isotropic smoother with these arguments would have this one's system.
  bool is_same(double length, const Vector& trust, const Mask& features) const;

 private:
  const HeightField& field_;
  SmoothOptions options_;
  Mask features_;
  Vector weight_;  // #T: weight of the data term
  SpdSolve solve_;
};

}  // namespace reflines
