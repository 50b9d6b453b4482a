// Smooths a field of gradients over a surface (paper, section 4, "Smoothing") by an implicit step whose response is
// sharpened.
//
// One step, g -> mean of G over each triangle, minimises over vectors G at the vertices
//   sum_T A_T c_T |mean of G over T - g_T|^2 + l^4 E(G),
// where l = length / 2 pi, c_T is the trust weight of T and E the thin-plate energy (see vertex_hessian.h). Of a wave
// of wavelength w it keeps h = 1 / (1 + (length / w)^4), in all directions and however quads are cut. Linear fields
// have no Hessian energy, also at the border, so a field that is already fair is not bent there (diffusion bends it;
// the squared Laplacian leaves every harmonic border wave).
//
// The step is taken seven times with one factor, as p(h) = h^4 (35 - 84 h + 70 h^2 - 20 h^3), which is flattest at 0
// and at 1 (Kaiser and Hamming 1977, "Sharpening the response of a symmetric nonrecursive filter"): half of a wave
// stays at w = length, 3 % at 0.7 lengths, 97 % at 1.4.
#pragma once

#include <limits>
#include <vector>

#include "geometry/stencil.h"
#include "reflines/progress.h"
#include "reflines/smooth_target.h"
#include "reflines/spd_factorize.h"
#include "reflines/types.h"

namespace reflines {

// The elements of the systems of all lengths: one a triangle, whose "gradient" is the mean of its corners, and
// after these one a patch of a vertex, whose "Hessian" is M_v^-1/2 D_v (see vertex_hessian.h).
struct SmootherElements {
  Stencils stencils;        // #T + #P
  std::vector<int> center;  // #P: the vertex of each patch
};

SmootherElements make_smoother_elements(const HeightField& field);

class LineSmoother {
 public:
  // Assembles and factors the system; `field` outlives it. `along` (#T x 2) are gradients whose level lines are the
  // direction; read only for directional smoothing. `trust` (#T, 0 to 1) weights each triangle's gradient; `features`
  // (#T, see strong_features) keep their gradients and hardly count around them. Throws Cancelled; `progress` may be
  // null.
  LineSmoother(const HeightField& field, const SmootherElements& shared, const SmoothOptions& options,
               const PlaneVectors& along, const Vector& trust, Mask features, const SpdFactorize& factorize,
               const Progress* progress = nullptr);

  // Returns the smoothed field (#T x 2) of `gradient` (#T x 2). `longest` is the largest trusted |grad theta| in
  // radians / length: longer gradients, and longer changes by smoothing, are shortened to it, since they are artefacts
  // of thin triangles.
  PlaneVectors smooth(const PlaneVectors& gradient, double longest = std::numeric_limits<double>::infinity()) const;

  // Returns true where an isotropic smoother with these arguments would have this one's system.
  bool is_same(double length, const Vector& trust, const Mask& features) const;

 private:
  void filter_once(Vector& g) const;  // #T, in place
  Vector filter(const Vector& g) const;

  const HeightField& field_;
  SmoothOptions options_;
  Mask features_;
  Vector weight_;  // #T: weight of the data term
  SpdSolve solve_;
};

}  // namespace reflines
