#include "optimization/border_columns.h"

#include <algorithm>
#include <utility>

namespace reflines {
namespace {

// The columns computed at once, after which a cancellation is looked for: halves of 100,000 unknowns take 0.04 s, and
// whole columns 0.2 s.
constexpr int kBlock = 64, kWholeBlock = 16;

}  // namespace

void BorderColumns::clear() {
  unknowns_.clear();
  columns_.clear();
  products_.resize(0, 0);
  right_.resize(0);
}

void BorderColumns::use_halves(bool may) {
  const bool uses = may && solver_.has_halves();
  if (uses != has_halves_) clear();
  has_halves_ = uses;
}

int BorderColumns::find(int unknown) const {
  const auto place = std::find(unknowns_.begin(), unknowns_.end(), unknown);
  return place == unknowns_.end() ? -1 : static_cast<int>(place - unknowns_.begin());
}

void BorderColumns::add(const std::vector<int>& unknowns, const SparseMatrix& columns, const Progress* progress) {
  const int block = has_halves_ ? kBlock : kWholeBlock, all = static_cast<int>(unknowns.size());
  for (int first = 0, end = 0; first < all; first = end) {
    throw_if_cancelled(progress);
    end = std::min(first + block, all);
    add_some(columns.middleCols(first, end - first));
    unknowns_.insert(unknowns_.end(), unknowns.begin() + first, unknowns.begin() + end);
  }
}

void BorderColumns::add_some(const SparseMatrix& columns) {
  Eigen::MatrixXd solved;
  if (!has_halves_) {
    solved = columns;
    solver_.solve(solved);
    solves_ += static_cast<int>(columns.cols());
  }
  products_.conservativeResize(count() + columns.cols(), count() + columns.cols());
  SparseColumns::Rows other = SparseColumns::Rows::Zero(columns.rows(), SparseColumns::kWidth);
  int right = count();
  for (SparseColumns& own : has_halves_ ? solver_.solve_lower(columns) : split_columns(columns)) {
    const int size = own.count;
    if (has_halves_)
      other(own.row, Eigen::all) = own.value;
    else
      other.leftCols(size) = solved.middleCols(right - count(), size);
    columns_.push_back(std::move(own));
    int left = 0;
    for (const SparseColumns& block : columns_) {
      const auto product = block.transposed_times(other).topLeftCorner(block.count, size).eval();
      products_.block(left, right, block.count, size) = product;
      products_.block(right, left, size, block.count) = product.transpose();
      left += block.count;
    }
    other(columns_.back().row, Eigen::all).setZero();
    right += size;
  }
}

Vector BorderColumns::begin(const Vector& right) {
  if (right_.size() == 0 || right != right_) {
    right_ = solved_ = right;
    has_halves_ ? solver_.solve_lower(solved_) : solver_.solve(solved_);
    solves_ += has_halves_ ? 0 : 1;
  }
  Vector result(count());
  int first = 0;
  for (const SparseColumns& block : columns_) {
    result.segment(first, block.count) = block.transposed_times(solved_);
    first += block.count;
  }
  return result;
}

Vector BorderColumns::finish(const Vector& z) {
  if (!has_halves_ && z.isZero(0)) return solved_;
  return finish_from(has_halves_ ? solved_ : right_, z);
}

Vector BorderColumns::respond(const Vector& z) { return -finish_from(Vector::Zero(right_.size()), z); }

// Takes off B z, and makes the solve whole.
Vector BorderColumns::finish_from(Vector x, const Vector& z) {
  int first = 0;
  for (const SparseColumns& block : columns_) {
    block.subtract_product(z.segment(first, block.count), x);
    first += block.count;
  }
  has_halves_ ? solver_.solve_upper(x) : solver_.solve(x);
  ++solves_;
  return x;
}

}  // namespace reflines
