#include "native/optimization/unknowns.h"

#include <utility>

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
  unknowns.moving_count_ = n;
  return unknowns;
}

Unknowns::Unknowns(const SparseMatrix& B, Vector x, const Vector& z)
    : rows_(B), transposed_(B.transpose()), column_(z.size(), -1), start_(std::move(x)) {
  offset_ = z - rows_ * start_;
  for (int v = 0; v < z.size(); ++v) {
    if (rows_.outerIndexPtr()[v] < rows_.outerIndexPtr()[v + 1])
      column_[v] = moving_count_++;
    else
      offset_(v) = z(v);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < z.size(); ++v) {
    for (decltype(rows_)::InnerIterator it(rows_, v); it; ++it) {
      entries.emplace_back(static_cast<int>(it.col()), column_[v], it.value());
    }
  }
  modes_.resize(size(), moving_count_);
  modes_.setFromTriplets(entries.begin(), entries.end());
}

void Unknowns::heights(const Vector& x, Vector& z) const {
  if (modes_.size() > 0) {
    z = offset_;
    z.noalias() += rows_ * x;
    return;
  }
  z.resize(offset_.size());
  for (int v = 0; v < z.size(); ++v) z(v) = column_[v] < 0 ? offset_(v) : x(column_[v]);
}

void Unknowns::pull_back(const Vector& along_z, Vector& along_x) const {
  if (modes_.size() > 0) {
    along_x.noalias() = transposed_ * along_z;
    return;
  }
  for (size_t v = 0; v < column_.size(); ++v) {
    if (column_[v] >= 0) along_x(column_[v]) = along_z(static_cast<int>(v));
  }
}

}  // namespace reflines
