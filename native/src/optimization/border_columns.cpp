#include "optimization/border_columns.h"

#include <algorithm>
#include <iterator>
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
  halves_.clear();
  products_.resize(0, 0);
  right_.resize(0);
}

void BorderColumns::use_halves(bool may) {
  if (count() > 0) return;
  has_halves_ = may && solver_.has_halves();
  right_.resize(0);
}

int BorderColumns::find(int unknown) const {
  const auto place = std::find(unknowns_.begin(), unknowns_.end(), unknown);
  return place == unknowns_.end() ? -1 : static_cast<int>(place - unknowns_.begin());
}

void BorderColumns::add(const std::vector<int>& unknowns, const SparseMatrix& columns, const Progress* progress) {
  has_halves_ ? add_halves(columns, progress) : add_whole(columns, progress);
  columns_.push_back(columns);
  unknowns_.insert(unknowns_.end(), unknowns.begin(), unknowns.end());
}

void BorderColumns::add_halves(const SparseMatrix& columns, const Progress* progress) {
  std::vector<SparseColumns> halves;
  for (Eigen::Index first = 0; first < columns.cols(); first += kBlock) {
    throw_if_cancelled(progress);
    const Eigen::Index count = std::min<Eigen::Index>(kBlock, columns.cols() - first);
    std::vector<SparseColumns> some = solver_.solve_lower(columns.middleCols(first, count));
    std::move(some.begin(), some.end(), std::back_inserter(halves));
  }
  products_.conservativeResize(count() + columns.cols(), count() + columns.cols());
  Eigen::Index right = count();
  for (SparseColumns& half : halves) {
    halves_.push_back(std::move(half));
    multiply_last_half(right);
    right += halves_.back().value.cols();
  }
}

// Computes the products of the last block of halves, whose first column is `right`, with itself and those before it.
void BorderColumns::multiply_last_half(Eigen::Index right) {
  Eigen::Index left = 0;
  for (const SparseColumns& half : halves_) {
    const Eigen::MatrixXd product = half.transposed_times(halves_.back());
    products_.block(left, right, product.rows(), product.cols()) = product;
    products_.block(right, left, product.cols(), product.rows()) = product.transpose();
    left += half.value.cols();
  }
}

void BorderColumns::add_whole(const SparseMatrix& columns, const Progress* progress) {
  Eigen::MatrixXd products(count() + columns.cols(), columns.cols());
  for (Eigen::Index first = 0; first < columns.cols(); first += kWholeBlock) {
    throw_if_cancelled(progress);
    const Eigen::Index size = std::min<Eigen::Index>(kWholeBlock, columns.cols() - first);
    Eigen::MatrixXd solved = columns.middleCols(first, size);
    solver_.solve(solved);
    Eigen::Index row = 0;
    for (const SparseMatrix& before : columns_) {
      products.block(row, first, before.cols(), size) = before.transpose() * solved;
      row += before.cols();
    }
    products.block(row, first, columns.cols(), size) = columns.transpose() * solved;
  }
  const int before = count();
  products_.conservativeResize(products.rows(), products.rows());
  products_.rightCols(columns.cols()) = products;
  products_.bottomLeftCorner(columns.cols(), before) = products.topRows(before).transpose();
  solves_ += static_cast<int>(columns.cols());
}

Vector BorderColumns::begin(const Vector& right) {
  if (right_.size() == 0 || right != right_) {
    right_ = solved_ = right;
    has_halves_ ? solver_.solve_lower(solved_) : solver_.solve(solved_);
    solves_ += has_halves_ ? 0 : 1;
  }
  return multiply_transposed(solved_);
}

Vector BorderColumns::multiply_transposed(const Vector& x) const {
  Vector result(count());
  Eigen::Index first = 0;
  const auto append = [&](const Vector& part) {
    result.segment(first, part.size()) = part;
    first += part.size();
  };
  if (has_halves_) {
    for (const SparseColumns& block : halves_) append(block.transposed_times(x));
  } else {
    for (const SparseMatrix& columns : columns_) append(columns.transpose() * x);
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
  Eigen::Index first = 0;
  if (has_halves_) {
    for (const SparseColumns& block : halves_) {
      block.subtract_product(z.segment(first, block.value.cols()), x);
      first += block.value.cols();
    }
    solver_.solve_upper(x);
  } else {
    for (const SparseMatrix& columns : columns_) {
      x -= columns * z.segment(first, columns.cols());
      first += columns.cols();
    }
    solver_.solve(x);
  }
  ++solves_;
  return x;
}

}  // namespace reflines
