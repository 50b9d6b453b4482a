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
// pivot is not positive.
//
// Without `split` no parallel region is entered: even one of a single thread makes a team, which costs GCC's OpenMP for
// Windows semaphores of the system. Milliseconds of one core with such regions and without, to factor 10,000 and
// 100,000 unknowns: under Wine 53 and 7, 800 and 360; on Linux 10.2 and 8.5, 299 and 283.
bool factorize_front(const DenseFront& front, bool split);

}  // namespace reflines
