#include "native/motion.h"

#include <string>

#include "native/errors.h"

namespace reflines {
namespace {

void check(const Motion& motion, int vertex_count) {
  if (motion.B.rows() == vertex_count && motion.B.cols() == motion.x.size()) return;
  throw InvalidInput("The motion is a matrix of " + std::to_string(motion.B.rows()) + " x " +
                     std::to_string(motion.B.cols()) + " for " + std::to_string(vertex_count) + " vertices and " +
                     std::to_string(motion.x.size()) + " unknowns; hand over one row a vertex, one column an unknown.");
}

bool moves_held(const Motion& motion, const HeightField& field, int unknown) {
  for (SparseMatrix::InnerIterator it(motion.B, unknown); it; ++it) {
    const VertexRole role = field.role[it.row()];
    if (role == VertexRole::kFixed || role == VertexRole::kClamped) return true;
  }
  return false;
}

}  // namespace

std::vector<int> couple(const Motion& motion, HeightField& field) {
  check(motion, field.vertex_count());
  std::vector<int> kept;
  std::vector<bool> moves(field.vertex_count(), false);
  for (int j = 0; j < motion.B.cols(); ++j) {
    if (moves_held(motion, field, j)) continue;
    kept.push_back(j);
    for (SparseMatrix::InnerIterator it(motion.B, j); it; ++it) moves[it.row()] = true;
  }
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kFree && !moves[v]) field.role[v] = VertexRole::kFixed;
  }
  field.piece.assign(field.triangle_count(), 0);
  field.piece_count = 1;
  return kept;
}

Unknowns unknowns_of(const Motion& motion, const std::vector<int>& kept, const Piece& piece) {
  const int size = static_cast<int>(piece.vertex.size());
  if (motion.empty()) {
    Mask is_free(size);
    for (int v = 0; v < size; ++v) is_free(v) = piece.field.role[v] == VertexRole::kFree;
    return Unknowns::free_vertices(is_free, piece.field.z);
  }
  std::vector<int> local(motion.B.rows(), -1);
  for (int v = 0; v < size; ++v) local[piece.vertex[v]] = v;
  std::vector<Eigen::Triplet<double>> entries;
  Vector x(kept.size());
  for (int k = 0; k < x.size(); ++k) {
    x(k) = motion.x(kept[k]);
    for (SparseMatrix::InnerIterator it(motion.B, kept[k]); it; ++it) {
      if (local[it.row()] >= 0) entries.emplace_back(local[it.row()], k, it.value());
    }
  }
  SparseMatrix B(size, x.size());
  B.setFromTriplets(entries.begin(), entries.end());
  return Unknowns(B, x, piece.field.z);
}

}  // namespace reflines
