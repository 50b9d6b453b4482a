// First and second derivatives of all triangles at once, and the transposed product: u = D z and D^T y.
#pragma once

#include "native/geometry/stencil.h"
#include "native/types.h"

namespace reflines {

// #T x 5, one row a triangle: f_x, f_y, f_xx, f_xy, f_yy.
using TriangleDerivatives = Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>;

// Which stencil entries name each vertex: the rows of D^T. Gathering by vertex instead of scattering by triangle makes
// the sums independent of the number of threads.
struct StencilEntries {
  Incidence entries_of_vertex;
  std::vector<int> triangle;  // #entries: whose stencil an entry belongs to

  StencilEntries(const Stencils& stencils, int vertex_count);
};

// u = D z for heights z (#V); `u` keeps its memory.
void apply_stencils(const Stencils& stencils, const Vector& z, TriangleDerivatives& u);

// D^T y (#V) for one 5-vector a triangle; `result` and the work space `products` (#entries) keep their memory.
void apply_transposed(const Stencils& stencils, const StencilEntries& entries, const TriangleDerivatives& y,
                      Vector& products, Vector& result);

}  // namespace reflines
