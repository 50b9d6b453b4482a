#include "optimization/affine_map.h"

#include <utility>

namespace reflines {

AffineMap AffineMap::select_vertices(const Mask& is_free, const Vector& z) {
  AffineMap map;
  map.moving_index_.assign(z.size(), -1);
  map.offset_ = z;
  map.start_.resize(is_free.count());
  int n = 0;
  for (int v = 0; v < z.size(); ++v) {
    if (!is_free(v)) continue;
    map.start_(n) = z(v);
    map.moving_index_[v] = n++;
  }
  map.moving_count_ = n;
  return map;
}

AffineMap::AffineMap(const SparseMatrix& B, Vector x, const Vector& z)
    : rows_(B), transposed_(B.transpose()), moving_index_(z.size(), -1), start_(std::move(x)) {
  offset_ = z - rows_ * start_;
  for (int v = 0; v < z.size(); ++v) {
    if (rows_.outerIndexPtr()[v] < rows_.outerIndexPtr()[v + 1])
      moving_index_[v] = moving_count_++;
    else
      offset_(v) = z(v);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < z.size(); ++v) {
    for (decltype(rows_)::InnerIterator it(rows_, v); it; ++it) {
      entries.emplace_back(static_cast<int>(it.col()), moving_index_[v], it.value());
    }
  }
  moving_transposed_.resize(size(), moving_count_);
  moving_transposed_.setFromTriplets(entries.begin(), entries.end());
}

void AffineMap::apply(const Vector& x, Vector& z) const {
  if (!is_selection()) {
    z = offset_;
    z.noalias() += rows_ * x;
    return;
  }
  z.resize(offset_.size());
  for (int v = 0; v < z.size(); ++v) z(v) = moving_index_[v] < 0 ? offset_(v) : x(moving_index_[v]);
}

void AffineMap::pull_back(const Vector& along_z, Vector& along_x) const {
  if (!is_selection()) {
    along_x.noalias() = transposed_ * along_z;
    return;
  }
  for (size_t v = 0; v < moving_index_.size(); ++v) {
    if (moving_index_[v] >= 0) along_x(moving_index_[v]) = along_z(static_cast<int>(v));
  }
}

}  // namespace reflines
