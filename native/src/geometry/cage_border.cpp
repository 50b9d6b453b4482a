#include "geometry/cage_border.h"

#include <algorithm>
#include <array>
#include <vector>

namespace reflines {
namespace {

// Marks the columns that have an entry in one of the rows.
void mark_columns(const SparseMatrix& matrix, const Mask& rows, Mask* columns) {
  for (int column = 0; column < matrix.cols(); ++column) {
    for (SparseMatrix::InnerIterator it(matrix, column); it; ++it) {
      if (rows[it.row()]) (*columns)[column] = true;
    }
  }
}

}  // namespace

Mask find_refined_border(const Subdivision& subdivision, const Mask& region) {
  const auto& faces = subdivision.faces;
  std::vector<std::array<int, 2>> edges;
  for (int f = 0; f < faces.rows(); ++f) {
    if (!region[subdivision.face_parent[f]]) continue;
    for (int i = 0; i < faces.cols(); ++i) {
      const auto [first, second] = std::minmax(faces(f, i), faces(f, (i + 1) % faces.cols()));
      edges.push_back({first, second});
    }
  }
  std::sort(edges.begin(), edges.end());
  Mask border = Mask::Constant(subdivision.positions.rows(), false);
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(), [&](const auto& edge) { return edge != *begin; });
    if (end - begin == 1) border[(*begin)[0]] = border[(*begin)[1]] = true;
    begin = end;
  }
  return border;
}

Mask find_held_vertices(const Subdivision& subdivision, const Mask& region, Border hold) {
  const Mask border = find_refined_border(subdivision, region);
  Mask held = Mask::Constant(subdivision.positions.cols(), false);
  if (hold != Border::kFree) mark_columns(subdivision.positions, border, &held);
  if (hold == Border::kClamped) {
    mark_columns(subdivision.tangent_u, border, &held);
    mark_columns(subdivision.tangent_v, border, &held);
  }
  Mask inside = Mask::Constant(held.size(), false);
  for (int f = 0; f < subdivision.faces.rows(); ++f) {
    if (!region[subdivision.face_parent[f]]) continue;
    for (const int vertex : subdivision.faces.row(f)) {
      if (vertex < held.size()) inside[vertex] = true;  // the cage's own vertices are the first refined ones
    }
  }
  return held || !inside;
}

}  // namespace reflines
