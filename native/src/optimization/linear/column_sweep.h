// Triangular solves with one dense block of a supernodal factor.
#pragma once

namespace reflines {

// The block of a supernode: the lower triangle of its own columns, and the rows below, column by column.
struct FactorBlock {
  int columns, below;
  const double* value;  // columns + below x columns

  int height() const { return columns + below; }
  const double* column(int j) const { return value + static_cast<long long>(j) * height(); }
};

// A solve reads blocks that lie one behind the other, and does little with each number: it is as fast as the blocks
// come from memory. So a forward sweep reads one column after the other, each once, in the order of memory, and both
// sweeps prefetch what follows: a forward sweep takes half of the time of Eigen's products, which read a few rows of
// all columns at once. The bits are those of Eigen's products.

// Overwrites x (#columns) with L^-1 x for the triangle L, and writes the product of the rows below with it to `below`.
// `work` has the length of a column.
void sweep_forward(const FactorBlock& block, double* x, double* below, double* work);

// Overwrites x (#columns) with L^-T (x - B^T below) for the rows B below.
void sweep_backward(const FactorBlock& block, const double* below, double* x);

}  // namespace reflines
