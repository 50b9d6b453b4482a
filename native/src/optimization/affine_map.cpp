#include "optimization/affine_map.h"

#include <utility>

namespace reflines {

AffineMap AffineMap::select_vertices(const std::vector<int>& leader, const Vector& z) {
  AffineMap map;
  map.moving_index_.assign(z.size(), -1);
  for (int v = 0; v < z.size(); ++v) {
    if (leader[v] != v) continue;
    map.moving_index_[v] = map.moving_count_++;
    map.leaders_.push_back(v);
  }
  map.start_ = z(map.leaders_);
  map.offset_ = z;
  for (int v = 0; v < z.size(); ++v) {
    if (leader[v] < 0) continue;
    map.has_followers_ = map.has_followers_ || leader[v] != v;
    map.moving_index_[v] = map.moving_index_[leader[v]];
    map.offset_(v) -= z(leader[v]);
  }
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
  z = offset_;
  for (int v = 0; v < z.size(); ++v) {
    if (moving_index_[v] >= 0) z(v) += x(moving_index_[v]);
  }
}

void AffineMap::pull_back(const Vector& along_z, Vector& along_x) const {
  if (!is_selection()) {
    along_x.noalias() = transposed_ * along_z;
    return;
  }
  along_x.setZero();
  for (size_t v = 0; v < moving_index_.size(); ++v) {
    if (moving_index_[v] >= 0) along_x(moving_index_[v]) += along_z(static_cast<int>(v));
  }
}

}  // namespace reflines
