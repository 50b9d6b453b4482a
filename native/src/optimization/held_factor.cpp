#include "optimization/held_factor.h"

namespace reflines {

void HeldFactor::factorize(const SparseMatrix& H, const Sides& held, const Vector& added) {
  matrix_ = H;
  for (int column = 0; column < H.cols(); ++column) {
    const bool column_held = held[column] != Side::kBetween;
    for (SparseMatrix::InnerIterator entry(matrix_, column); entry; ++entry) {
      if (entry.row() == column) {
        if (added.size() > 0) entry.valueRef() += added(column);
      } else if (column_held || held[entry.row()] != Side::kBetween) {
        entry.valueRef() = 0.0;
      }
    }
  }
  solver_.factorize(matrix_, progress_);
}

void HeldFactor::solve(const Sides& held, Vector& x) const {
  const auto clear = [&] {
    for (int k = 0; k < x.size(); ++k) {
      if (held[k] != Side::kBetween) x(k) = 0.0;
    }
  };
  clear();
  solver_.solve(x);
  clear();
}

}  // namespace reflines
