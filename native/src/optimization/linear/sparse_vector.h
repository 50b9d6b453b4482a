// A vector with few entries that are not zero.
#pragma once

#include <vector>

#include "reflines/types.h"

namespace reflines {

// The entries that are not zero, by ascending index. Sums are taken in that order, so that their bits are always the
// same.
struct SparseVector {
  std::vector<int> index;
  std::vector<double> value;

  double dot(const SparseVector& other) const;
  double dot(const Vector& dense) const;
  void add_to(Vector& dense, double factor) const;
};

}  // namespace reflines
