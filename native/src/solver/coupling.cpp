#include "solver/coupling.h"

#include <string>

#include "reflines/errors.h"
#include "solver/mirror_coupling.h"

namespace reflines {
namespace {

void check_size(const SparseMatrix& B, const Vector& start, int vertex_count) {
  if (B.rows() == vertex_count && B.cols() == start.size()) return;
  throw InvalidInput("The motion is a matrix of " + std::to_string(B.rows()) + " x " + std::to_string(B.cols()) +
                     " for " + std::to_string(vertex_count) + " vertices and " + std::to_string(start.size()) +
                     " unknowns; hand over one row a vertex, one column an unknown.");
}

// Returns true where an unknown moves a vertex that stays. One that lies on no piece, as on the side of a body that is
// turned away, stays, too: an unknown that moved nothing else had an empty column, and one that moved both carried it
// beyond its limit.
bool moves_held_vertex(const SparseMatrix& B, const HeightField& field, int unknown) {
  for (SparseMatrix::InnerIterator it(B, unknown); it; ++it) {
    if (field.role[it.row()] != VertexRole::kFree) return true;
  }
  return false;
}

}  // namespace

std::vector<int> couple_vertices(const SparseMatrix& B, const Vector& start, HeightField& field) {
  check_size(B, start, field.vertex_count());
  std::vector<int> free_unknowns;
  std::vector<bool> moves(field.vertex_count(), false);
  for (int j = 0; j < B.cols(); ++j) {
    if (moves_held_vertex(B, field, j)) continue;
    free_unknowns.push_back(j);
    for (SparseMatrix::InnerIterator it(B, j); it; ++it) moves[it.row()] = true;
  }
  for (int v = 0; v < field.vertex_count(); ++v) {
    if (field.role[v] == VertexRole::kFree && !moves[v]) field.role[v] = VertexRole::kFixed;
  }
  field.piece.assign(field.triangle_count(), 0);
  field.piece_count = 1;
  return free_unknowns;
}

AffineMap make_affine_map(const SparseMatrix& B, const Vector& start, const std::vector<int>& free_unknowns,
                          const Piece& piece) {
  if (B.rows() == 0) return AffineMap::select_vertices(choose_leaders(piece), piece.field.z);
  const int size = static_cast<int>(piece.vertex.size());
  std::vector<int> local(B.rows(), -1);
  for (int v = 0; v < size; ++v) local[piece.vertex[v]] = v;
  std::vector<Eigen::Triplet<double>> entries;
  Vector x(free_unknowns.size());
  for (int k = 0; k < x.size(); ++k) {
    x(k) = start(free_unknowns[k]);
    for (SparseMatrix::InnerIterator it(B, free_unknowns[k]); it; ++it) {
      if (local[it.row()] >= 0) entries.emplace_back(local[it.row()], k, it.value());
    }
  }
  SparseMatrix restricted(size, x.size());
  restricted.setFromTriplets(entries.begin(), entries.end());
  return AffineMap(restricted, x, piece.field.z);
}

}  // namespace reflines
