// Partial Cholesky factorization of one dense front of the multifrontal method.
#pragma once

namespace reflines {

// A front: the columns of a supernode with all their rows, stored as one block of the factor, and its update matrix,
// which is what remains for the rows below. Column by column, lower triangles.
struct DenseFront {
  int columns, below;
  double* block;   // columns + below x columns
  double* update;  // below x below

  int height() const { return columns + below; }
  double* at(int row, int column) const { return block + static_cast<long long>(column) * height() + row; }
};

// Overwrites the block with the columns of the factor L, and adds -B B^T to the update matrix, where B are the rows
// below. `split` computes large fronts by tiles on all cores; tiles have the same bits on one. Returns false where a
// pivot is not positive. Without `split` no parallel region is entered: under Wine even those of a single thread take
// seven times as long.
bool factorize_front(const DenseFront& front, bool split);

}  // namespace reflines
