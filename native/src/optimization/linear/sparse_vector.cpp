#include "optimization/linear/sparse_vector.h"

namespace reflines {

double SparseVector::dot(const SparseVector& other) const {
  double sum = 0.0;
  for (size_t i = 0, j = 0; i < index.size() && j < other.index.size();) {
    if (index[i] == other.index[j]) {
      sum += value[i++] * other.value[j++];
    } else if (index[i] < other.index[j]) {
      ++i;
    } else {
      ++j;
    }
  }
  return sum;
}

double SparseVector::dot(const Vector& dense) const {
  double sum = 0.0;
  for (size_t i = 0; i < index.size(); ++i) sum += value[i] * dense(index[i]);
  return sum;
}

void SparseVector::add_to(Vector& dense, double factor) const {
  for (size_t i = 0; i < index.size(); ++i) dense(index[i]) += factor * value[i];
}

}  // namespace reflines
