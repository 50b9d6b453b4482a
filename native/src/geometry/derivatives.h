// Computes the first and second derivatives of all triangles, u = D z, and the transposed product D^T y.
#pragma once

#include "geometry/stencil.h"
#include "reflines/types.h"

namespace reflines {

// The derivatives f_x, f_y, f_xx, f_xy, f_yy of one triangle.
using Vector5 = Eigen::Matrix<double, 5, 1>;
// The derivatives of all triangles, #T x 5.
using TriangleDerivatives = Eigen::Matrix<double, Eigen::Dynamic, 5, Eigen::RowMajor>;

// The stencil entries of each vertex: the rows of D^T. Gathering by vertex instead of scattering by triangle makes the
// sums independent of the number of threads.
struct StencilEntries {
  Incidence entries_of_vertex;
  std::vector<int> triangle;  // #entries: triangle of the stencil that an entry belongs to

  StencilEntries(const Stencils& stencils, int vertex_count);
};

// Computes u = D z for heights z (#V); `u` keeps its memory.
void apply_stencils(const Stencils& stencils, const Vector& z, TriangleDerivatives& u);

// Computes the derivatives of triangle t alone.
inline Vector5 apply_stencil(const Stencils& stencils, int t, const Vector& z) {
  const int first = stencils.offset[t];
  const double* weight = stencils.gradient.data() + 6 * static_cast<size_t>(t);
  const double a = z(stencils.vertex[first]), b = z(stencils.vertex[first + 1]), c = z(stencils.vertex[first + 2]);
  double xx = 0, xy = 0, yy = 0;
  for (int e = first; e < stencils.offset[t + 1]; ++e) {
    const double height = z(stencils.vertex[e]);
    const double* second = stencils.hessian.data() + 3 * static_cast<size_t>(e);
    xx += second[0] * height;
    xy += second[1] * height;
    yy += second[2] * height;
  }
  return {weight[0] * a + weight[2] * b + weight[4] * c, weight[1] * a + weight[3] * b + weight[5] * c, xx, xy, yy};
}

// Computes the first pass of D^T y, which takes two passes that both read the large arrays in order (fetching an
// entry's weights from the vertex's side took five times as long, for they lie far apart): a triangle's y times the
// weights of its entries go to `products` (#entries), and `sum_products` sums those of each vertex into `result` (#V).
inline void multiply_stencil(const Stencils& stencils, int t, const Vector5& y, Vector& products) {
  const int first = stencils.offset[t];
  const double* gradient = stencils.gradient.data() + 6 * static_cast<size_t>(t);
  for (int e = first; e < stencils.offset[t + 1]; ++e) {
    const double* second = stencils.hessian.data() + 3 * static_cast<size_t>(e);
    products(e) = second[0] * y(2) + second[1] * y(3) + second[2] * y(4);
  }
  for (int i = 0; i < 3; ++i) products(first + i) += gradient[2 * i] * y(0) + gradient[2 * i + 1] * y(1);
}
void sum_products(const StencilEntries& entries, const Vector& products, Vector& result);

}  // namespace reflines
