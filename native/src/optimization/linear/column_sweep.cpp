#include "optimization/linear/column_sweep.h"

#include <Eigen/Core>
#include <algorithm>

namespace reflines {
namespace {

using Segment = Eigen::Map<Eigen::VectorXd>;
using ConstSegment = Eigen::Map<const Eigen::VectorXd>;
using Pair = Eigen::Array2d;
using Square = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

// The columns whose triangle is solved before the rows below it.
constexpr int kPanel = 8;

// The number of columns from which products are summed by groups: shorter chains have less rounding.
constexpr int kWide = 128, kGroup = 16;

// The distance in numbers at which memory is prefetched: 32 kB, a few blocks of usual size. With 8 to 32 kB a solve
// takes the same time.
constexpr int kAhead = 4096, kCacheLine = 8;

// Prefetches memory that is read soon; it may lie outside the factor. The second level of the cache takes more requests
// at once than the first: blocks of 72 x 16 numbers come backward at 24 instead of 8 GB/s.
void prefetch(const double* place, long long numbers) {
  for (long long i = 0; i < numbers; i += kCacheLine) __builtin_prefetch(place + i, 0, 2);
}

void add_column(const double* column, int rows, double factor, double* result) {
  Segment(result, rows).noalias() += factor * ConstSegment(column, rows);
}

Pair load(const double* place) { return Eigen::Map<const Pair>(place); }

// Subtracts from x the products of columns with r, each summed by even and odd rows.
template <int kColumns>
void subtract_products(const double* first, long long stride, const double* r, int rows, double* x) {
  Pair sum[kColumns];
  for (Pair& own : sum) own.setZero();
  int i = 0;
  for (; i + 2 <= rows; i += 2) {
    const Pair factor = load(r + i);
    for (int j = 0; j < kColumns; ++j) sum[j] += load(first + j * stride + i) * factor;
  }
  for (int j = 0; j < kColumns; ++j) {
    double all = sum[j](0) + sum[j](1);
    if (i < rows) all += first[j * stride + i] * r[i];
    x[j] -= all;
  }
}

// The panel of columns first .. first + count - 1 of a block.
struct Panel {
  const FactorBlock& block;
  int first, count;

  int end() const { return first + count; }
  int rest() const { return block.columns - end(); }  // rows of the triangle below the panel's own
  Square diagonal() const { return {block.column(first) + first, count, count, Eigen::OuterStride<>(block.height())}; }

  void subtract_rows(int row, const double* r, int rows, double* x) const {
    const double* const place = block.column(first) + row;
    if (count == kPanel) return subtract_products<kPanel>(place, block.height(), r, rows, x + first);
    for (int j = 0; j < count; ++j)
      subtract_products<1>(block.column(first + j) + row, block.height(), r, rows, x + first + j);
  }
};

}  // namespace

void sweep_forward(const FactorBlock& block, double* x, double* below, double* work) {
  const bool wide = block.columns >= kWide;
  double* const inside = work;                                // what a panel adds to the rows of the triangle
  double* const group = wide ? work + block.columns : below;  // and a group of panels to those below
  std::fill_n(below, block.below, 0.0);
  for (int first = 0; first < block.columns; first += kPanel) {
    const Panel panel{block, first, std::min(kPanel, block.columns - first)};
    if (wide && first % kGroup == 0) std::fill_n(group, block.below, 0.0);
    Segment own(x + first, panel.count);
    panel.diagonal().triangularView<Eigen::Lower>().solveInPlace(own);
    std::fill_n(inside, panel.rest(), 0.0);
    for (int j = first; j < panel.end(); ++j) {
      prefetch(block.column(j) + kAhead, block.height());
      add_column(block.column(j) + panel.end(), panel.rest(), x[j], inside);
      add_column(block.column(j) + block.columns, block.below, x[j], group);
    }
    Segment(x + panel.end(), panel.rest()) -= Segment(inside, panel.rest());
    if (wide && (panel.end() % kGroup == 0 || panel.rest() == 0))
      Segment(below, block.below) += Segment(group, block.below);
  }
}

void sweep_backward(const FactorBlock& block, const double* below, double* x) {
  if (block.columns == 1) {
    prefetch(block.value - kAhead, block.height());
    x[0] -= ConstSegment(block.column(0) + 1, block.below).dot(ConstSegment(below, block.below));
    x[0] /= block.value[0];
    return;
  }
  for (int end = block.columns; end > 0; end -= kPanel) {
    const int first = std::max(0, end - kPanel);
    const Panel panel{block, first, end - first};
    prefetch(block.column(first) - kAhead, static_cast<long long>(panel.count) * block.height());
    panel.subtract_rows(block.columns, below, block.below, x);
    panel.subtract_rows(end, x + end, panel.rest(), x);
    Segment own(x + first, panel.count);
    panel.diagonal().transpose().triangularView<Eigen::Upper>().solveInPlace(own);
  }
}

}  // namespace reflines
