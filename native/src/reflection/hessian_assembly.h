// The sparse Hessian D^T M D over the unknown heights: the pattern is built once, values often, on all cores with the
// same bits.
#pragma once

#include <vector>

#include "geometry/derivatives.h"
#include "reflection/energy.h"
#include "reflines/types.h"

namespace reflines {

class HessianAssembly {
 public:
  // Builds the pattern. `column` (#V) is the unknown that each vertex moves with, several with the same, or -1 where
  // it is fixed; unknowns are 0 .. unknown_count - 1.
  HessianAssembly(const Stencils& stencils, const StencilEntries& entries, std::vector<int> column, int unknown_count);

  const SparseMatrix& pattern() const { return H_; }  // lower triangle, n x n; values only after `assemble`

  // Returns the lower triangle, n x n; the pattern never changes. `diagonal` (#V, may be empty) is added. The reference
  // stays valid and is overwritten by the next call.
  const SparseMatrix& assemble(const Energy::ElementHessians& elements, const Vector& diagonal);

 private:
  void append_rows(int unknown, std::vector<int>& last, std::vector<int>& rows) const;
  void fill_column(int unknown, const Energy::ElementHessians& elements, std::vector<int>& position);
  void add_vertex(int v, int unknown, const Energy::ElementHessians& elements, const std::vector<int>& position);

  const Stencils& stencils_;
  const StencilEntries& entries_;
  std::vector<int> column_;  // #V
  Incidence vertices_;       // of each unknown
  // The work space of each thread: the position of a row in the column being filled; for the pattern the last column
  // with the row.
  std::vector<std::vector<int>> position_;
  SparseMatrix H_;
};

}  // namespace reflines
