#include "native/optimization/unknowns.h"

namespace reflines {

Unknowns Unknowns::free_vertices(const Mask& is_free, const Vector& z) {
  Unknowns unknowns;
  unknowns.column_.assign(z.size(), -1);
  unknowns.offset_ = z;
  unknowns.start_.resize(is_free.count());
  int n = 0;
  for (int v = 0; v < z.size(); ++v) {
    if (!is_free(v)) continue;
    unknowns.start_(n) = z(v);
    unknowns.column_[v] = n++;
  }
  return unknowns;
}

Unknowns::Unknowns(SparseMatrix B, Vector x, const Vector& z) : B_(std::move(B)), start_(std::move(x)) {
  offset_ = z - B_ * start_;
}

void Unknowns::heights(const Vector& x, Vector& z) const {
  if (column_.empty()) {
    z = offset_;
    z.noalias() += B_ * x;
    return;
  }
  z.resize(offset_.size());
  for (int v = 0; v < z.size(); ++v) z(v) = column_[v] < 0 ? offset_(v) : x(column_[v]);
}

void Unknowns::pull_back(const Vector& along_z, Vector& along_x) const {
  if (column_.empty()) {
    along_x.noalias() = B_.transpose() * along_z;
    return;
  }
  for (size_t v = 0; v < column_.size(); ++v) {
    if (column_[v] >= 0) along_x(column_[v]) = along_z(static_cast<int>(v));
  }
}

}  // namespace reflines
