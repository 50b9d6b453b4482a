// Triangle-centred first and second derivatives of heights over the image plane (paper, section 3 and appendix).
#pragma once

#include <string>
#include <vector>

#include "geometry/height_field.h"
#include "reflines/stencil_kind.h"
#include "reflines/types.h"

namespace reflines {

// The first and second derivatives as weights on heights. For triangle t the entries e = offset[t] .. offset[t + 1] - 1
// name the vertices; the first three are the triangle's own corners, which alone carry the gradient.
struct Stencils {
  std::vector<int> offset;                                             // #T + 1
  std::vector<int> vertex;                                             // #entries
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> hessian;   // #entries x 3: weights of f_xx, f_xy, f_yy
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> gradient;  // #T x 6: weights of (f_x, f_y) for each corner
  int fallback_count = 0;  // triangles whose six-point quadratic was wanted but is not used

  int triangle_count() const { return static_cast<int>(offset.size()) - 1; }
};

// Returns the stencils of the named triangles, in that order.
Stencils select_stencils(const Stencils& all, const std::vector<int>& triangles);

// The Hessian weights of one triangle before they are packed.
struct HessianStencil {
  std::vector<int> vertex;  // the triangle's corners first
  Eigen::Matrix3Xd weight;  // 3 x #vertex
  bool empty() const { return vertex.empty(); }
};

// Computes the stencils of the triangles of `field` in its order. Throws InvalidInput for kQuadratic where some
// triangle has none.
Stencils make_stencils(const HeightField& field, StencilKind kind);

// Compute the single discretizations; each returns an empty stencil where it is not defined.
HessianStencil averaged_hessian(const HeightField& field, int t);
HessianStencil quadratic_hessian(const HeightField& field, int t);
HessianStencil ring_hessian(const HeightField& field, int t);

// Marks triangles (#T) at a border or crease whose own heights, and those across their edges, are all held. Their
// six-point stencils do not move; a ring would take in free heights beyond, all on one side, and is of first order
// only.
Mask held_at_border(const HeightField& field);

}  // namespace reflines
