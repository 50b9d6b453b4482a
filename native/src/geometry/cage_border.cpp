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

std::vector<Border> refine_border(const Subdivision& subdivision, const Mask& region,
                                  const std::vector<Border>& border) {
  const Mask on_border = find_refined_border(subdivision, region);
  constexpr double kEqual = 1e-9;  // weights add up to 1
  std::vector<Border> result(on_border.size(), Border::kFree);
  Vector largest = Vector::Zero(on_border.size());
  for (int v = 0; v < subdivision.positions.cols(); ++v) {
    if (!on_border[v]) continue;  // the cage's own vertices are the first refined ones
    for (SparseMatrix::InnerIterator it(subdivision.positions, v); it; ++it) {
      const auto row = it.row();
      if (!on_border[row] || it.value() < largest[row] - kEqual) continue;
      result[row] = it.value() > largest[row] + kEqual ? border[v] : std::max(result[row], border[v]);
      largest[row] = std::max(largest[row], it.value());
    }
  }
  return result;
}

Mask find_held_vertices(const Subdivision& subdivision, const Mask& region, const std::vector<Border>& border) {
  const std::vector<Border> refined = refine_border(subdivision, region, border);
  Mask fixed(subdivision.positions.rows()), clamped(subdivision.positions.rows());
  for (size_t i = 0; i < refined.size(); ++i) {
    fixed[static_cast<int>(i)] = refined[i] != Border::kFree;
    clamped[static_cast<int>(i)] = refined[i] >= Border::kClamped;
  }
  Mask held = Mask::Constant(subdivision.positions.cols(), false);
  mark_columns(subdivision.positions, fixed, &held);
  mark_columns(subdivision.tangent_u, clamped, &held);
  mark_columns(subdivision.tangent_v, clamped, &held);
  Mask inside = Mask::Constant(held.size(), false);
  for (int f = 0; f < subdivision.faces.rows(); ++f) {
    if (!region[subdivision.face_parent[f]]) continue;
    for (const int vertex : subdivision.faces.row(f)) {
      if (vertex < held.size()) inside[vertex] = true;
    }
  }
  return held || !inside;
}

}  // namespace reflines
