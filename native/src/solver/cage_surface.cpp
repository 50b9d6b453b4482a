#include "solver/cage_surface.h"

#include <algorithm>
#include <string>
#include <vector>

#include "geometry/cage_border.h"
#include "geometry/cage_symmetry.h"
#include "geometry/mesh.h"
#include "reflines/errors.h"
#include "solver/mirror_coupling.h"

namespace reflines {
namespace {

constexpr int kRings = 4;        // of refined faces beside the region: fits take in three rings of triangles
constexpr int kSparseLevel = 3;  // coarser surfaces have too few triangles for sampling

void check_length(Eigen::Index length, Eigen::Index wanted, const std::string& what) {
  if (length == 0 || length == wanted) return;
  throw InvalidInput("The " + what + " has " + std::to_string(length) + " entries; the cage needs " +
                     std::to_string(wanted) + ".");
}

void check_arrays(const Cage& cage, const Positions& V, const CageOptions& options) {
  if (V.rows() != cage.vertices) {
    throw InvalidInput("There are " + std::to_string(V.rows()) + " positions for the " + std::to_string(cage.vertices) +
                       " vertices of the cage; give one for each.");
  }
  if (!V.allFinite()) {
    const auto good = V.array().isFinite().rowwise().all().count();
    throw InvalidInput(std::to_string(V.rows() - good) + " of the " + std::to_string(cage.vertices) +
                       " vertices of the cage have a coordinate that is not a finite number; delete or retype them.");
  }
  check_length(options.region.size(), cage.face_offsets.size() - 1, "region mask");
  check_length(static_cast<Eigen::Index>(options.border.size()), cage.vertices, "list of border codes");
  check_length(options.held.size(), cage.vertices, "held mask");
  check_partners(options.partner, cage.vertices);
  check_length(options.image_of.size(), cage.face_offsets.size() - 1, "list of mirrored faces");
}

// Numbers the refined vertices in faces of the region, -1 for the others; fills `refined` with the inverse map. The
// order is that of the faces, whose neighbours in the list are neighbours on the surface, so that the energy reads its
// heights from nearby memory.
std::vector<int> number_vertices(const Subdivision& whole, const Mask& region, IndexVector& refined) {
  std::vector<int> number(whole.positions.rows(), -1);
  refined.resize(whole.positions.rows());
  int count = 0;
  for (int f = 0; f < whole.faces.rows(); ++f) {
    if (!region(whole.face_parent(f))) continue;
    for (const int v : whole.faces.row(f)) {
      if (number[v] >= 0) continue;
      refined(count) = v;
      number[v] = count++;
    }
  }
  refined.conservativeResize(count);
  return number;
}

SparseMatrix select_rows(const SparseMatrix& matrix, const std::vector<int>& number, int count) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < matrix.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
      if (number[it.row()] >= 0) entries.emplace_back(number[it.row()], j, it.value());
    }
  }
  SparseMatrix result(count, matrix.cols());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

void set_positions(const Positions& V, const IndexVector& partner, CageSurface& surface) {
  if (partner.size() == 0) {
    surface.positions = surface.S * V;
    return;
  }
  const IndexVector refined_partner = find_refined_partners(surface.S, partner);
  surface.S = symmetrize(surface.S, partner, refined_partner);
  surface.positions = multiply_symmetric(surface.S, partner, refined_partner, V);
}

// Returns a triangle's quadrature weight on a sampled surface. The last level cuts faces into four: one of them stands
// for all, of a quad one of its triangles, alternately the first and the second. Always the same one would favour bends
// in one direction (errors of 7 % of the move instead of 0.6 %, as much as a coarser level makes).
double sparse_weight(int face, int piece, int pieces) {
  const bool loop = pieces == 1;
  if (face % 4 != (loop ? 3 : 0)) return 0.0;  // Loop: the middle one
  if (loop) return 4.0;
  return face / 4 % 2 == piece ? 8.0 : 0.0;
}

// Cuts quads into triangles from their first corner, which subdivision orients in the same way all over a face of the
// cage.
void cut_faces(const Subdivision& whole, const Mask& region, const std::vector<int>& number, CageSurface& surface) {
  const int pieces = static_cast<int>(whole.faces.cols()) - 2;
  surface.F.resize(pieces * whole.faces.rows(), 3);
  surface.parent.resize(surface.F.rows());
  surface.quadrature_weight.resize(surface.F.rows());
  int count = 0;
  for (int f = 0; f < whole.faces.rows(); ++f) {
    if (!region(whole.face_parent(f))) continue;
    for (int k = 0; k < pieces; ++k, ++count) {
      surface.F.row(count) << number[whole.faces(f, 0)], number[whole.faces(f, k + 1)], number[whole.faces(f, k + 2)];
      surface.parent(count) = whole.face_parent(f);
      surface.quadrature_weight(count) = sparse_weight(f, k, pieces);
    }
  }
  surface.F.conservativeResize(count, 3);
  surface.parent.conservativeResize(count);
  surface.quadrature_weight.conservativeResize(count);
}

void check_bridge(const CageBridge& bridge, const CageSurface& surface, Eigen::Index faces) {
  check_length(bridge.left_out.size(), surface.F.rows(), "mask of triangles that are left out");
  const bool in_range = bridge.F.size() == 0 || (bridge.F.minCoeff() >= 0 && bridge.F.maxCoeff() < surface.S.rows());
  const bool has_parents = bridge.parent.size() == bridge.F.rows() && (bridge.parent.array() >= 0).all() &&
                           (bridge.parent.array() < faces).all();
  if (in_range && has_parents) return;
  throw InvalidInput("The " + std::to_string(bridge.F.rows()) + " triangles over the gap need corners among the " +
                     std::to_string(surface.S.rows()) + " vertices of the surface, and a face of the cage each.");
}

// Leaves vertices out that are in no triangle, which would hold the cage's vertices that move them; updates the numbers
// of the refined vertices.
void drop_unused(std::vector<int>& number, CageSurface& surface) {
  std::vector<int> kept;
  std::vector<int> renumbered(surface.S.rows(), -1);
  for (const int v : surface.F.reshaped()) renumbered[v] = 0;
  for (size_t v = 0; v < renumbered.size(); ++v) {
    number[surface.refined(static_cast<int>(v))] = -1;
    if (renumbered[v] < 0) continue;
    renumbered[v] = static_cast<int>(kept.size());
    number[surface.refined(static_cast<int>(v))] = renumbered[v];
    kept.push_back(static_cast<int>(v));
  }
  for (int& v : surface.F.reshaped()) v = renumbered[v];
  surface.S = select_rows(surface.S, renumbered, static_cast<int>(kept.size()));
  surface.positions = Positions(surface.positions(kept, Eigen::all));
  surface.refined = IndexVector(surface.refined(kept));
}

// Leaves the triangles at the rims out, and adds those over the gap.
void lay_bridge(const CageBridge& bridge, std::vector<int>& number, CageSurface& surface) {
  const Eigen::Index before = surface.F.rows(), added = bridge.F.rows();
  std::vector<int> kept;
  for (int f = 0; f < before; ++f) {
    if (bridge.left_out.size() == 0 || !bridge.left_out(f)) kept.push_back(f);
  }
  const auto count = static_cast<Eigen::Index>(kept.size());
  Triangles F(count + added, 3);
  IndexVector parent(count + added);
  Vector weight = Vector::Ones(count + added);
  F << surface.F(kept, Eigen::all), bridge.F;
  parent << surface.parent(kept), bridge.parent;
  weight.head(count) = surface.quadrature_weight(kept);
  surface.F = F;
  surface.parent = parent;
  surface.quadrature_weight = weight;
  drop_unused(number, surface);
}

// Marks the refined faces outside the region that are within kRings rings of a vertex where lines run on.
Mask find_faces_beside(const Subdivision& whole, const Mask& region, const std::vector<Border>& border) {
  Mask near(whole.positions.rows()), result = Mask::Constant(whole.faces.rows(), false);
  for (size_t v = 0; v < border.size(); ++v) near[static_cast<int>(v)] = border[v] == Border::kFlow;
  for (int ring = 0; ring < kRings; ++ring) {
    for (int f = 0; f < whole.faces.rows(); ++f) {
      for (const int v : whole.faces.row(f)) result[f] = result[f] || (near[v] && !region[whole.face_parent[f]]);
    }
    for (int f = 0; f < whole.faces.rows(); ++f) {
      for (const int v : whole.faces.row(f)) near[v] = near[v] || result[f];
    }
  }
  return result;
}

// Reads the border with Border::kFlow and the faces beside it. With kCurvature nothing is to be done: the curvature
// stays, see find_held_vertices.
void read_surroundings(const Subdivision& whole, const Mask& region, const std::vector<Border>& border,
                       std::vector<int> number, const Positions& V, CageSurface& surface) {
  surface.border.assign(surface.S.rows(), Border::kFree);
  if (std::find(border.begin(), border.end(), Border::kFlow) == border.end()) return;
  const std::vector<Border> refined = refine_border(whole, region, border);
  for (size_t v = 0; v < refined.size(); ++v) {
    if (number[v] >= 0 && refined[v] == Border::kFlow) surface.border[number[v]] = Border::kFlow;
  }
  const Mask beside = find_faces_beside(whole, region, refined);
  std::vector<int> added;
  std::vector<Eigen::RowVector3i> triangles;
  for (int f = 0; f < whole.faces.rows(); ++f) {
    if (!beside[f]) continue;
    for (const int v : whole.faces.row(f)) {
      if (number[v] >= 0) continue;
      number[v] = static_cast<int>(surface.S.rows() + static_cast<Eigen::Index>(added.size()));
      added.push_back(v);
    }
    for (int k = 2; k < whole.faces.cols(); ++k)
      triangles.emplace_back(number[whole.faces(f, 0)], number[whole.faces(f, k - 1)], number[whole.faces(f, k)]);
  }
  const Positions all = whole.positions * V;
  surface.around.V = all(added, Eigen::all);
  surface.around.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (size_t t = 0; t < triangles.size(); ++t) surface.around.F.row(static_cast<Eigen::Index>(t)) = triangles[t];
}

// Returns the positions of the vertices in faces; the others may be anywhere.
Positions positions_in_faces(const Cage& cage, const Positions& V) {
  Mask in_face = Mask::Constant(V.rows(), false);
  for (const int v : cage.face_vertices) in_face(v) = true;
  return V(list_marked(in_face), Eigen::all);
}

}  // namespace

CageSurface make_cage_surface(const Cage& cage, const Positions& V, const Vector3& view, const CageOptions& options) {
  check_arrays(cage, V, options);
  Progress* progress = options.shape.progress.get();
  const auto enter = [progress](double fraction, const char* stage) {
    if (progress != nullptr) progress->enter(fraction, stage);
  };
  enter(0.0, "subdividing");
  const Subdivision whole = subdivide(cage, options.subdivision, progress);
  enter(0.5, "choosing the region");
  const Mask region = options.region.size() > 0 ? options.region : Mask::Constant(cage.face_offsets.size() - 1, true);
  std::vector<Border> border = options.border;
  if (border.empty()) border.assign(cage.vertices, Border::kClamped);
  Mask held = find_held_vertices(whole, region, border);
  if (options.held.size() > 0) held = held || options.held;
  CageSurface surface;
  std::vector<int> number = number_vertices(whole, region, surface.refined);
  surface.S = select_rows(whole.positions, number, static_cast<int>(surface.refined.size()));
  enter(0.8, "placing the surface");
  set_positions(V, options.partner, surface);
  enter(0.9, "cutting faces");
  cut_faces(whole, region, number, surface);
  check_bridge(options.bridge, surface, region.size());
  if (options.bridge.F.rows() > 0) lay_bridge(options.bridge, number, surface);
  read_surroundings(whole, region, border, number, V, surface);
  if (!options.sparse || options.subdivision.level < kSparseLevel) surface.quadrature_weight.resize(0);
  surface.B = build_cage_unknowns(held, options.partner);
  // A vertex in no face, a thousand kilometres away, would take five digits from heights around the mean of all.
  const Positions in_faces = positions_in_faces(cage, V);
  const Vector heights = (V.rowwise() - in_faces.colwise().mean()) * view.normalized();
  surface.start.resize(surface.B.cols());
  for (int k = 0; k < surface.start.size(); ++k) {
    surface.start(k) = heights(SparseMatrix::InnerIterator(surface.B, k).row());
  }
  return surface;
}

}  // namespace reflines
