#include "geometry/cage_border.h"

#include <algorithm>
#include <vector>

#include "reflines/cage.h"

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
  std::vector<int> inside;
  for (int f = 0; f < subdivision.faces.rows(); ++f) {
    if (region[subdivision.face_parent[f]]) inside.push_back(f);
  }
  const int count = static_cast<int>(subdivision.positions.rows());
  Mask border = Mask::Constant(count, false);
  for (const CageEdge& edge : cage_edges(cage_from_faces(count, subdivision.faces(inside, Eigen::all)))) {
    if (edge.faces == 1) border[edge.first] = border[edge.second] = true;
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
