// Smoothing of a field of gradients over a surface (paper, section 4, "Smoothing"), by one implicit step.
//
// G (a vector at every vertex) minimises sum_T A_T (c_T |mean of G over T - g_T|^2 + l^4 |Hessian of G|^2), where
// l = length / 2 pi and c_T says how far T is believed. A wave of wavelength w keeps 1 / (1 + (length / w)^4) of its
// amplitude: half at w = length, 6 % at half of it, 94 % at twice. The Hessian's energy knows linear fields as zero
// also at the border, so a field that is already fair is not bent there (diffusion bends it; the squared Laplacian
// leaves every harmonic border wave).
#pragma once

#include <functional>
#include <limits>

#include "native/geometry/stencil.h"
#include "native/types.h"

namespace reflines {

// Factors a symmetric positive definite matrix (lower triangle) and returns the solve x <- A^-1 x.
using SpdSolve = std::function<void(Vector&)>;
using SpdFactorize = std::function<SpdSolve(const SparseMatrix&)>;

struct SmoothOptions {
  double length = 0.0;       // wavelength that is halved, in the mesh's unit of length; 0 changes nothing
  bool directional = false;  // only along the lines: they become straight, their spacing across stays
  // |grad theta|, radians a length: gradients and changes that are longer count as if they were so long, since they are
  // read off a thin triangle.
  double longest = std::numeric_limits<double>::infinity();
};

class FieldSmoother {
 public:
  // `along` (#T x 2) gives the gradient whose level lines are the direction; read only for directional smoothing.
  // `trust` (#T, 0 to 1) says how far each triangle's gradient is to be believed; `features` (#T, see strong_features)
  // stay as they are and hardly count around them.
  FieldSmoother(const HeightField& field, const Stencils& stencils, const SmoothOptions& options,
                const PlaneVectors& along, const Vector& trust, Mask features, const SpdFactorize& factorize);

  // The smoothed field (#T x 2) of `gradient` (#T x 2).
  PlaneVectors smooth(const PlaneVectors& gradient) const;

 private:
  const HeightField& field_;
  double longest_;
  Mask features_;
  Vector weight_;  // #T: of the data term
  SpdSolve solve_;
};

}  // namespace reflines
